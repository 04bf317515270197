// What a field beside a run costs, part by part: computing it, its slices, lines and layers, and its files.
//   bench_field_files BED [ROUNDS]     BED: a particle file; 3 x 0.5 x 1.7 mm of it in 17.3 um voxels
// Parts are done in turns, one thread; a row is the median of the rounds. "with both" is what a run does.
#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "coupling/io/field_files.h"
#include "coupling/io/field_grains.h"
#include "coupling/io/particle_reader.h"
#include "tests/bench/timing.h"

namespace {

namespace io = interstice::io;
namespace voxel = interstice::voxel;
namespace fs = std::filesystem;
using interstice::Box;
using interstice::bench::Seconds;

io::FieldFilesRequest request_of(const Box& box) {
  io::FieldFilesRequest request;
  request.box = box;
  request.computed.lattice = voxel::cubic_lattice(box, 17.3e-6);
  request.slices = {{0, 1.5e-3}, {2, 0.5e-3}};
  request.lines = {{0, {0, 0.25e-3, 0.5e-3}}};
  voxel::LayerRequest layers;
  layers.box = box;
  layers.columns = {72, 2};
  request.layers = layers;
  request.tables = "tables";
  return request;
}

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

void measure(const voxel::SpheresView& spheres, int rounds) {
  const Box box{{0, 0, 0}, {3e-3, 0.5e-3, 1.7e-3}};
  const io::FieldFilesRequest both = request_of(box);
  io::FieldFilesRequest tables = both, vdb = both, vti = both;
  tables.vdb = tables.vti = vdb.vti = vti.vdb = false;
  voxel::Field field;
  struct Part {
    const char* name;
    std::function<void(const fs::path&)> work;
    std::vector<double> processor{}, wall{};
    std::uintmax_t bytes = 0;
  };
  const auto files = [&](const io::FieldFilesRequest& request) {
    return [&](const fs::path& folder) { io::write_field_files(folder, field, spheres, {}, request); };
  };
  std::vector<Part> parts{
      {"the field", [&](const fs::path&) { field = voxel::compute_field(spheres, {}, both.computed); }},
      {"slices, lines, layers and their tables", files(tables)},
      {"these with the .vdb", files(vdb)},
      {"these with the .vti", files(vti)},
      {"these with both", files(both)}};
  const fs::path work = fs::temp_directory_path() / fmt::format("bench_field_files-{}", getpid());
  for (int round = 0; round < rounds; ++round)
    for (Part& part : parts) {
      const fs::path folder = work / "out";
      fs::create_directories(folder);
      const Seconds seconds = interstice::bench::timed([&] { part.work(folder); });
      part.processor.push_back(seconds.processor);
      part.wall.push_back(seconds.wall);
      part.bytes = bytes_in(folder);
      fs::remove_all(work);
    }
  fmt::print("| what | processor ms: median (least) | wall ms: median (least) | MB |\n|---|---|---|---|\n");
  for (const Part& part : parts) {
    const auto processor = interstice::bench::spread_of(part.processor),
               wall = interstice::bench::spread_of(part.wall);
    fmt::print("| {} | {:.1f} ({:.1f}) | {:.1f} ({:.1f}) | {:.2f} |\n", part.name, 1e3 * processor.median,
               1e3 * processor.least, 1e3 * wall.median, 1e3 * wall.least,
               1e-6 * static_cast<double>(part.bytes));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: bench_field_files BED [ROUNDS]\n");
    return 2;
  }
  openvdb::initialize();
  io::ParticleFrame frame;
  io::open_particles(argv[1], {})->next(frame);
  interstice::bench::on_threads(1, [&] { measure(io::view_of(frame), argc > 2 ? std::atoi(argv[2]) : 15); });
}
