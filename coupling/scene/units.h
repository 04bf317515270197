// Numbers with their unit written out, as people write them in scenes and on the command line: "40 um",
// "0.05 m/s", "1 MJ/m^3", "200 rpm", "35 %". Everything becomes SI at once; a bare number where a unit is due
// is refused, because every paper behind this tool carries a unit slip.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace interstice::scene {

enum class Dimension {
  dimensionless,
  length,
  area,
  volume,
  time,
  frequency,
  velocity,
  acceleration,
  mass,
  density,
  force,
  energy,
  pressure,        // Young's modulus too
  energy_density,  // the same base units as a pressure; named apart for messages
  surface_energy,
  stiffness,  // the same base units as a surface energy
  angle,
  angular_velocity,
};

/// What one calls a dimension in a sentence ("a length"), its SI unit as one writes it ("m", "" if none), and
/// a typical value to show how it is written ("40 um").
struct DimensionInfo {
  std::string_view noun;
  std::string_view si_unit;
  std::string_view example;
};
const DimensionInfo& info(Dimension dimension);

/// Why a text is not a quantity, in the three parts of every input error.
struct QuantityProblem {
  std::string what;     // what is wrong
  std::string allowed;  // what is allowed
  std::string remedy;   // what to do
};

/// The value in SI units. On failure: empty, and `problem` says why. A decimal number times a decimal unit is
/// rounded once, so "40 um" is exactly the double 4e-5.
std::optional<double> try_parse_quantity(std::string_view text, Dimension expected, QuantityProblem& problem);

/// The same for the command line: throws InputError "key: what; allowed; remedy" (key: "--voxel").
double parse_quantity(std::string_view text, Dimension expected, std::string_view key);

inline double parse_length(std::string_view text, std::string_view key) {
  return parse_quantity(text, Dimension::length, key);
}
inline double parse_time(std::string_view text, std::string_view key) {
  return parse_quantity(text, Dimension::time, key);
}

/// A unit apart from its number, such as the "um" of a column header "x [um]".
class Unit {
 public:
  /// Empty, and `problem` filled, when the text is no unit of that dimension.
  static std::optional<Unit> parse(std::string_view text, Dimension expected, QuantityProblem& problem);
  /// The number `text` in this unit, in SI; empty when it is not a finite decimal number.
  std::optional<double> value(std::string_view text) const;

 private:
  friend std::optional<double> try_parse_quantity(std::string_view, Dimension, QuantityProblem&);
  int power_of_ten_ = 0;
  double factor_ = 1;  // what is not a power of ten: 60 in "min"
};

/// Text without the blanks at its ends.
std::string_view trim(std::string_view text);

/// Whether the whole text is one decimal number (that no unit follows), as in "-1.5e3".
bool is_bare_number(std::string_view text);

}  // namespace interstice::scene
