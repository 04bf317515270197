// Counter-based random numbers: value k of stream s is a pure function of (seed, s, k), so results depend on
// neither the order of the calls nor the number of threads. Mixing function: SplitMix64 (Steele, Lea & Flood,
// OOPSLA 2014, fig. 17), applied twice.
#pragma once

#include <cstdint>

namespace interstice {

class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream)
      : key_(mix(mix(seed) ^ (stream * 0x9E3779B97F4A7C15ull))) {}

  /// Uniform in the open interval (0, 1).
  double uniform() { return (static_cast<double>(mix(key_ ^ mix(counter_++)) >> 11) + 0.5) * 0x1.0p-53; }
  double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }

  std::uint64_t counter() const { return counter_; }
  void set_counter(std::uint64_t counter) { counter_ = counter; }

 private:
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z += 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace interstice
