#include "coupling/scene/read_scene.h"

#include <fmt/format.h>

#include "base/error.h"
#include "coupling/scene/document.h"
#include "coupling/scene/overrides.h"
#include "coupling/scene/readers.h"

namespace interstice::scene {
namespace {

Output read_output(const TableReader& table) {
  Output output;
  output.trajectory = table.quantity("trajectory");
  output.series = table.quantity("series");
  output.checkpoint = table.quantity("checkpoint");
  output.energy = table.boolean("energy");
  if (output.energy && output.series == 0)
    table.error("energy", "is true, and there is no series to hold it",
                "it is allowed with output.series above 0 s", "add series = \"1 ms\", or drop this key");
  return output;
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides,
                 std::vector<std::string>* warnings) {
  return read_scene_text(read_text_file(path), path, overrides, warnings);
}

Scene read_scene_text(std::string_view text, const std::string& source,
                      const std::vector<std::string>& overrides, std::vector<std::string>* warnings) {
  Value document = parse_document(text, source);
  Problems problems;
  for (const std::string& assignment : overrides) apply_override(document, assignment, problems);

  const TableReader root(&document, section(""), "", document.place, problems);
  Scene scene;
  scene.file = source;
  scene.title = root.text("title");
  if (root.has("domain")) scene.domain = read_domain(root.raw("domain"), root.place("domain"), problems);
  scene.materials = read_materials(root.raw("materials"), problems);
  scene.contact = read_contact(root.raw("contact"), root.place("contact"), problems);
  scene.particles = read_particles(root, source);
  scene.walls = read_walls(root);
  scene.phases = read_phases(root);

  const TableReader time(root.raw("time"), section("time"), "time", root.place(), problems);
  scene.step = read_time_step(time);
  scene.seed = static_cast<std::uint64_t>(time.integer("seed").value_or(1));

  const TableReader output(root.raw("output"), section("output"), "output", root.place(), problems);
  scene.output = read_output(output);
  scene.fields = read_fields(root);

  check_scene(scene, document, problems);
  problems.throw_if_any();
  if (warnings) {
    const auto found = problems.warnings();
    warnings->insert(warnings->end(), found.begin(), found.end());
  }
  return scene;
}

}  // namespace interstice::scene
