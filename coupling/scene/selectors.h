// Places in a field as one line of text, the same in scenes and on the command line: a box, a slice, a line.
#pragma once

#include <optional>
#include <string_view>

#include "base/shapes.h"
#include "coupling/scene/scene.h"
#include "coupling/scene/units.h"

namespace interstice::scene {

/// "x0,x1,y0,y1,z0,z1" with a unit on every number. Throws InputError "key: ..." (key: "--box").
Box parse_box(std::string_view text, std::string_view key);

/// "x=4.5mm"
Slice parse_slice(std::string_view text, std::string_view key);
std::optional<Slice> try_parse_slice(std::string_view text, QuantityProblem& problem);

/// "y@x=9mm,z=35um"
Line parse_line(std::string_view text, std::string_view key);
std::optional<Line> try_parse_line(std::string_view text, QuantityProblem& problem);

/// "z0,z1,NX,NY": the height of the columns and how many there are along x and y.
FieldLayers parse_layers(std::string_view text, std::string_view key);

/// "um" or "mm" alone, as in `--length-unit um` or `FILE.stl@mm`: how many metres one of it is.
double parse_length_unit(std::string_view text, std::string_view key);

}  // namespace interstice::scene
