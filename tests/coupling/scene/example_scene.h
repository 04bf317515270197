// A good scene that names every section, for tests that change one thing in it.
#pragma once

#include <string>
#include <string_view>

namespace interstice::scene {

inline const std::string kExampleScene = R"(title = "Example"

[domain]
box = [["0 mm", "2 mm"], ["-0.5 mm", "0.5 mm"], ["0 mm", "3 mm"]]
boundary = ["open", "wall", "open"]
wall_material = "steel"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]

[materials.powder]
density = "8200 kg/m^3"
youngs_modulus = "1 GPa"
poisson_ratio = 0.3
[materials.steel]
density = "7.8 g/cm^3"
youngs_modulus = "1 GPa"
poisson_ratio = 0.29

[contact]
normal = "hertz"
damping = "tension"
tangential = "mindlin"
rolling = "cdt"
cohesion = "sjkr"
[[contact.pair]]
materials = ["powder", "powder"]
restitution = 0.35
friction = 0.3
rolling_friction = 0.005
cohesion_energy_density = "1 MJ/m^3"
[[contact.pair]]  # with the walls
materials = ["steel", "powder"]
restitution = "35 %"
friction = 0.9
rolling_friction = 0.006
cohesion_energy_density = "10 kJ/m^3"

[[particles]]
name = "feed"
material = "powder"
count = 1000
diameter = { distribution = "normal", mean = "39.4 um", sd = "10.5 um", min = "5 um", max = "65 um" }
insert = { method = "rain", phase = "pour", box = [["0.1 mm", "1 mm"], ["-0.4 mm", "0.4 mm"], ["1.5 mm", "2.1 mm"]] }

[[walls]]
name = "substrate"
material = "steel"
shape = { plane = { point = ["0 m", "0 m", "0 m"], normal = [0, 0, 2] } }
watch = true
[[walls]]
name = "blade"
material = "steel"
shape = { box = { center = ["-0.1 mm", "0 mm", "1.07 mm"], size = ["0.2 mm", "1.5 mm", "2 mm"] } }
motion = [{ phase = "spread", velocity = ["0.05 m/s", "0 m/s", "0 m/s"] }]

[[phases]]
name = "pour"
until = { inserted = true, settled = true, at_most = "100 ms" }
[[phases]]  # the last
name = "spread"
duration = "40 ms"

[time]
step = { rayleigh = 0.2, collision = 0.04 }
seed = 7

[output]
trajectory = "10 ms"
series = "0.1 ms"
checkpoint = "60 s"

[[fields]]
name = "layer"
voxel = "17.3 um"
box = [["0 mm", "2 mm"], ["-0.25 mm", "0.25 mm"], ["0 mm", "0.1 mm"]]
every = "10 ms"
average = "120 um"
slices = ["x=0.5 mm", "x=1 mm"]
lines = ["y@x=1 mm,z=35 um"]
layers = { z = ["0 um", "70 um"], columns = [20, 5] }
)";

/// `text` with the one place where `from` stands replaced by `to`. Empty when it is not there exactly once.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos || text.find(from, at + 1) != std::string::npos) return {};
  return text.replace(at, from.size(), to);
}

/// The example with other laws of contact: `laws` in [contact], `parameters` in each of its two pairs.
inline std::string with_contact(std::string_view laws, std::string_view parameters) {
  const std::size_t from = kExampleScene.find("[contact]"), to = kExampleScene.find("[[particles]]");
  std::string contact = "[contact]\n" + std::string(laws) + "\n";
  for (const std::string pair : {"[\"powder\", \"powder\"]", "[\"steel\", \"powder\"]"})
    contact += "[[contact.pair]]\nmaterials = " + pair + "\n" + std::string(parameters) + "\n";
  return kExampleScene.substr(0, from) + contact + "\n" + kExampleScene.substr(to);
}

/// The line (from 1) on which `needle` first stands.
inline int line_of(const std::string& text, std::string_view needle) {
  const std::size_t at = text.find(needle);
  if (at == std::string::npos) return 0;
  int line = 1;
  for (std::size_t i = 0; i < at; ++i) line += text[i] == '\n';
  return line;
}

}  // namespace interstice::scene
