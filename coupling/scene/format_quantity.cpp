#include "coupling/scene/format_quantity.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

namespace interstice::scene {
namespace {

struct Prefix {
  std::string_view symbol;
  double scale;
};
constexpr std::array<Prefix, 8> kPrefixes{
    {{"G", 1e9}, {"M", 1e6}, {"k", 1e3}, {"", 1}, {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}, {"p", 1e-12}}};

/// Prefixes multiply the first symbol of the unit, so they suit only units where it stands to the first power
/// and where people use them: no km/s^2, no Gm, no ks, no Mkg/m^3.
bool takes_prefix(Dimension dimension, double scale) {
  switch (dimension) {
    case Dimension::length:
    case Dimension::time:
      return scale <= 1;
    case Dimension::velocity:
      return scale <= 1 && scale >= 1e-6;
    case Dimension::force:
    case Dimension::energy:
    case Dimension::pressure:
    case Dimension::energy_density:
    case Dimension::surface_energy:
    case Dimension::stiffness:
      return true;
    default:
      return scale == 1;
  }
}

std::string with_unit(const std::string& number, std::string_view prefix, Dimension dimension) {
  const std::string_view unit = info(dimension).si_unit;
  return unit.empty() ? number : fmt::format("{} {}{}", number, prefix, unit);
}

}  // namespace

std::string format_exact(double value, Dimension dimension) {
  return with_unit(fmt::format("{}", value), "", dimension);
}

std::string format_quantity(double value, Dimension dimension, int digits) {
  Prefix chosen{"", 1};
  if (value != 0 && std::isfinite(value)) {
    for (const Prefix& prefix :
         kPrefixes) {  // from large to small: the first that leaves a number of at least 1
      if (!takes_prefix(dimension, prefix.scale)) continue;
      chosen = prefix;
      // rounding may carry 999.96 over to 1000: that is the next prefix's 1
      if (std::abs(value) >= prefix.scale * (1 - 0.5 * std::pow(10.0, -digits))) break;
    }
  }
  // far beyond the last prefix the plain unit reads better: 1e+20 Pa
  const double shown = std::abs(value) / chosen.scale;
  if (shown >= 1e6 || shown < 1e-3) chosen = {"", 1};
  return with_unit(fmt::format("{:.{}g}", value / chosen.scale, digits), chosen.symbol, dimension);
}

}  // namespace interstice::scene
