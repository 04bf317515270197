// Times of one call, of what is repeated, and on how many threads.
#pragma once

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <vector>

namespace interstice::bench {

inline double wall_seconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Seconds of the wall clock and of all processors, of one call.
struct Seconds {
  double wall = 0, processor = 0;
};
inline Seconds timed(const std::function<void()>& work) {
  Seconds seconds;
  const std::clock_t begin = std::clock();
  seconds.wall = wall_seconds(work);
  seconds.processor = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return seconds;
}

struct Spread {
  double median, least, most;
};
inline Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[values.size() / 2], values.front(), values.back()};
}

template <class Work>
void on_threads(int threads, const Work& work) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  work();
}

}  // namespace interstice::bench
