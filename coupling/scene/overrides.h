// `path.to.key=value` of the command line, applied to a document before it is validated; and the way back,
// from such a path to its place in the file. Elements of arrays go by their index or by their name:
// "walls.blade.motion.0.velocity", "contact.pair.powder-tool.friction".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "coupling/scene/document.h"

namespace interstice::scene {

/// Sets the value; errors (no such element, no '=') go to `problems`. Keys that do not exist are made, so
/// that they are validated like those of the file.
void apply_override(Value& document, const std::string& assignment, Problems& problems);

/// The place of the value at `path`, or of the nearest table or array around it.
Place locate(const Value& document, std::string_view path);

/// How a path names the element `index` of an array: by its name if it has one that no other element has.
std::string element_name(const Value& array, std::size_t index);

}  // namespace interstice::scene
