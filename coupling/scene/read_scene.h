// From a scene file to a typed, validated Scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "coupling/scene/scene.h"

namespace interstice::scene {

/// Reads and validates a scene. `overrides` are "path.to.key=value" (the command's --set), applied in their
/// order before validation; elements of arrays go by name or index ("walls.blade.motion.0.velocity=...").
/// Every error of the file is thrown together, in one InputError whose lines read
/// "file:line:column: key: what is wrong; what is allowed; what to do". Warnings of implausible values go to
/// `warnings` when it is given.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides = {},
                 std::vector<std::string>* warnings = nullptr);

/// The same from text in memory; `source` names it in messages, and grain lists are looked for beside it.
Scene read_scene_text(std::string_view text, const std::string& source,
                      const std::vector<std::string>& overrides = {},
                      std::vector<std::string>* warnings = nullptr);

}  // namespace interstice::scene
