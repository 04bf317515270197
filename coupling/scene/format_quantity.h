// SI values as text: exactly, for the resolved scene, and rounded with a handy prefix, for people.
#pragma once

#include <string>

#include "coupling/scene/units.h"

namespace interstice::scene {

/// The shortest text that reads back as the very same double: "1.73e-05 m".
std::string format_exact(double value, Dimension dimension);

/// For people: "17.3 um", "0.05 m/s", "1 GPa"; at most `digits` significant digits.
std::string format_quantity(double value, Dimension dimension, int digits = 4);

inline std::string format_length(double metres) { return format_quantity(metres, Dimension::length); }
inline std::string format_time(double seconds) { return format_quantity(seconds, Dimension::time); }

}  // namespace interstice::scene
