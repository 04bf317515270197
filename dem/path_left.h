// What is left of how far grains may go before lists are made anew, kLanes at a time. In single precision,
// rounded to the safe side: never more is said to be left than is.
#pragma once

#include "dem/grain_motion.h"

namespace interstice::dem {

/// A length of each grain of a group [m].
using Lengths = simd::Pack<float, kLanes>;

/// As a number in single precision that is no greater.
inline float rounded_down(double length) { return static_cast<float>(length * (1 - 1e-6)); }

/// After a step of this squared length [m^2]. Both operations round by up to 2^-24 of what is left; as much
/// is taken away with every step, however short. Steps below 1e-18 m count as such: their squares underflow.
inline Lengths path_left_after(const Lengths& left, const Each& squared_step) {
  const Lengths squared = max_of(simd::converted<float>(squared_step), Lengths(1e-36));
  const Lengths length = squared * inverse_root_of(squared);
  return multiply_add(Lengths(-1 - 1e-6), length, multiply_add(Lengths(-0x1p-22), left, left));
}

}  // namespace interstice::dem
