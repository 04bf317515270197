// Damaged scenes are either read or refused with an InputError; nothing else may happen. Deterministic.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "base/random.h"
#include "coupling/scene/read_scene.h"
#include "coupling/scene/write_scene.h"
#include "tests/coupling/scene/example_scene.h"

namespace interstice::scene {
namespace {

class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed, 0) {}

  std::size_t below(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(random_.uniform() * static_cast<double>(n)));
  }

  /// One to four edits: a byte changed, a piece removed, a piece copied elsewhere, a nasty word put in.
  std::string apply(std::string text) {
    static const std::string words[] = {"nan",
                                        "inf",
                                        "-1",
                                        "0",
                                        "1e999",
                                        "[",
                                        "]",
                                        "{",
                                        "}",
                                        "\"",
                                        "'''",
                                        "\n",
                                        "=",
                                        ".",
                                        "\xff",
                                        "\xC2\xB5",
                                        std::string(1, '\0'),
                                        "99999999999999999999",
                                        "[[walls]]",
                                        "true",
                                        "\"um\"",
                                        "\"1e308 m\"",
                                        "1979-05-27",
                                        "\\u0000",
                                        ",",
                                        "#",
                                        "-0",
                                        "\"\"",
                                        "[,]",
                                        "\n[",
                                        "\n=",
                                        "\n."};
    for (std::size_t edits = 1 + below(4); edits > 0; --edits) {
      const std::size_t at = below(text.size() + 1);
      const std::size_t length = std::min(text.size() - at, 1 + below(12));
      switch (below(4)) {
        case 0:
          if (at < text.size()) text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(below(text.size() + 1), text.substr(at, length));
          break;
        default:
          text.replace(at, below(2) * length, words[below(std::size(words))]);
      }
    }
    return text;
  }

 private:
  Random random_;
};

std::vector<std::string> valid_scenes() {
  std::vector<std::string> scenes{
      kExampleScene,
      with_contact("normal = \"hooke\"\ntangential = \"slider\"\ncohesion = \"van_der_waals\"",
                   "restitution = 0.5\nstiffness = \"1 kN/m\"\nfriction = 0.3\nhamaker_constant = \"65 "
                   "zJ\"\ncutoff = \"0.165 nm\""),
      with_contact("damping = \"clipped\"\nrolling = \"epsd2\"\ncohesion = \"jkr\"",
                   "restitution = 0.5\nrolling_friction = 0.1\nsurface_energy = \"0.1 mJ/m^2\"")};
  for (const auto& entry : std::filesystem::directory_iterator(INTERSTICE_SOURCE_DIR "/data/scenes"))
    if (entry.path().extension() == ".toml") {
      std::ifstream file(entry.path());
      scenes.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
  return scenes;
}

TEST(SceneFuzz, DamagedScenesAreReadOrRefused) {
  auto scenes = valid_scenes();
  std::sort(scenes.begin(), scenes.end());
  Damage damage(20240611);
  int read = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::string text = damage.apply(scenes[damage.below(scenes.size())]);
    try {
      Scene scene = read_scene_text(text, "damaged.toml");
      const std::string resolved = resolved_toml(scene);
      Scene back = read_scene_text(resolved, "damaged.toml");
      ASSERT_TRUE(back == scene) << text;  // what is accepted can be written and read again
      ++read;
    } catch (const InputError& error) {
      ASSERT_FALSE(error.messages().empty());
      for (const std::string& message : error.messages())
        ASSERT_EQ(message.rfind("damaged.toml:", 0), 0u) << message << "\n" << text;
      ++refused;
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 1000);
}

TEST(SceneFuzz, DamagedOverridesAreTakenOrRefused) {
  const std::vector<std::string> good{
      "particles.feed.count=12", "walls.blade.motion.0.velocity=[\"1 m/s\", \"0 m/s\", \"0 m/s\"]",
      "time.step=8 ns", "fields.layer.slices=[\"x=1 mm\"]", "contact.pair.powder-steel.friction=0.5"};
  Damage damage(5);
  for (int i = 0; i < 2000; ++i) {
    const std::string text = damage.apply(good[damage.below(good.size())]);
    try {
      read_scene_text(kExampleScene, "x.toml", {text});
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace interstice::scene
