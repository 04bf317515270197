// Loops over fixed blocks of an index range. The blocks depend on the range alone, never on the number of
// threads, so that per-block partial results summed in block order give the same bits on any machine load.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace interstice {

struct Blocks {
  std::size_t size;   ///< indices in all
  std::size_t block;  ///< indices in a block (the last may be shorter)

  std::size_t count() const { return (size + block - 1) / block; }
  std::size_t begin(std::size_t b) const { return b * block; }
  std::size_t end(std::size_t b) const { return std::min(size, (b + 1) * block); }
};

/// Threads that a loop started here may use.
inline std::size_t threads() {
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::min(allowed, static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
}

/// Calls body(block, begin, end) for every block, on the threads of the current task arena.
template <class Body>
void for_each_block(const Blocks& blocks, const Body& body) {
  const std::size_t n = blocks.count();
  if (n <= 1 || threads() == 1) {
    for (std::size_t b = 0; b < n; ++b) body(b, blocks.begin(b), blocks.end(b));
    return;
  }
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, n, 1),
      [&](const tbb::blocked_range<std::size_t>& r) {
        for (std::size_t b = r.begin(); b != r.end(); ++b) body(b, blocks.begin(b), blocks.end(b));
      },
      tbb::static_partitioner());
}

}  // namespace interstice
