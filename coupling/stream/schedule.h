// When things happen, in whole time steps, so that a resumed run does them at the very same moments.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace interstice::stream {

/// Something done every so many steps; never when `every` is 0.
struct Recurrence {
  std::int64_t every = 0;

  static Recurrence of(double interval, double step) {
    if (!(interval > 0)) return {0};
    return {std::max<std::int64_t>(1, std::llround(interval / step))};
  }
  bool due(std::int64_t step) const { return every > 0 && step % every == 0; }
  /// The next due step after `step`.
  std::int64_t next(std::int64_t step) const { return every > 0 ? (step / every + 1) * every : INT64_MAX; }
};

/// Steps that cover a duration: a duration that is a whole number of steps but for rounding is that many.
inline std::int64_t steps_in(double duration, double step) {
  return std::max<std::int64_t>(0,
                                static_cast<std::int64_t>(std::ceil(duration / step * (1 - 1e-12) - 1e-9)));
}

}  // namespace interstice::stream
