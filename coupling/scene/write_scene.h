// A scene back to text: every value in force, in SI units, defaults included.
#pragma once

#include <string>

#include "coupling/scene/scene.h"

namespace interstice::scene {

/// The text of scene.resolved.toml. read_scene_text() of it gives an equal Scene, bit for bit (but for
/// Scene::file); placement lists stand in it as text, so that it needs no other file.
std::string resolved_toml(const Scene& scene);

}  // namespace interstice::scene
