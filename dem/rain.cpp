#include "dem/rain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "dem/wall_distance.h"

namespace interstice::dem {
namespace {

struct Ball {
  Vec3d position;
  double radius;
};

/// Balls by cell, for asking whether a new one overlaps any. Cells are no smaller than the largest ball, and
/// no more than a few for each ball that may come: a rain box may be any number of grains wide.
class Crowd {
 public:
  Crowd(const Box& box, double largest, std::size_t balls) {
    const Vec3d margin{largest, largest, largest};  // balls outside that reach in
    lo_ = box.lo - margin;
    const Vec3d size = box.hi + margin - lo_;
    const double roomy =
                     std::cbrt(size.x * size.y * size.z / (kCellsPerBall * static_cast<double>(balls + 1))),
                 edge = std::max(2 * largest, roomy);
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
      count_[axis] = std::max(1, static_cast<int>(size[axis] / edge));
      per_length_[axis] = count_[axis] / size[axis];
      cells *= static_cast<std::size_t>(count_[axis]);
    }
    first_.assign(cells, kNone);
    balls_.reserve(balls);
  }

  void add(const Ball& ball) {
    const Cell c = cell_of(ball.position);
    std::uint32_t& first = first_[index(c[0], c[1], c[2])];
    balls_.push_back({ball, std::exchange(first, static_cast<std::uint32_t>(balls_.size()))});
  }

  bool has_room(const Ball& ball) const {
    const Cell c = cell_of(ball.position);
    const auto low = [&](int axis) { return std::max(0, c[axis] - 1); };
    const auto high = [&](int axis) { return std::min(count_[axis] - 1, c[axis] + 1); };
    for (int k = low(2); k <= high(2); ++k) {
      for (int j = low(1); j <= high(1); ++j) {
        for (int i = low(0); i <= high(0); ++i) {
          if (touches(ball, first_[index(i, j, k)])) return false;
        }
      }
    }
    return true;
  }

 private:
  using Cell = std::array<int, 3>;
  struct Link {
    Ball ball;
    std::uint32_t next;  // in the same cell
  };
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr double kCellsPerBall = 4;

  bool touches(const Ball& ball, std::uint32_t at) const {
    for (; at != kNone; at = balls_[at].next) {
      const Ball& other = balls_[at].ball;
      const Vec3d apart = ball.position - other.position;
      const double reach = ball.radius + other.radius;
      if (dot(apart, apart) <= reach * reach) return true;
    }
    return false;
  }
  Cell cell_of(const Vec3d& p) const {
    Cell c;
    for (int axis = 0; axis < 3; ++axis) {
      c[axis] = std::clamp(static_cast<int>((p[axis] - lo_[axis]) * per_length_[axis]), 0, count_[axis] - 1);
    }
    return c;
  }
  std::size_t index(int i, int j, int k) const {
    const auto nx = static_cast<std::size_t>(count_[0]), ny = static_cast<std::size_t>(count_[1]);
    return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx +
           static_cast<std::size_t>(i);
  }

  Vec3d lo_, per_length_;
  Cell count_{};
  std::vector<std::uint32_t> first_;  // of each cell
  std::vector<Link> balls_;
};

bool clear_of_walls(const Simulation& sim, const Ball& ball) {
  return std::all_of(sim.walls().begin(), sim.walls().end(), [&](const Shape& wall) {
    return wall_distance(wall, ball.position).distance > ball.radius;
  });
}

}  // namespace

std::size_t pour(Simulation& sim, Rain& rain, int tries) {
  if (rain.finished()) return 0;
  double largest = *std::max_element(rain.radii.begin(), rain.radii.end());
  const std::vector<GrainRow> present = sim.rows();
  for (const GrainRow& g : present) largest = std::max(largest, g.radius);
  Crowd crowd(rain.box, largest, present.size() + rain.radii.size() - rain.next);
  for (const GrainRow& g : present) {
    const WallDistance d = wall_distance(rain.box, g.position());
    if (d.distance < g.radius) crowd.add({g.position(), g.radius});
  }
  std::vector<NewGrain> added;
  for (; !rain.finished(); ++rain.next) {
    Ball ball{{}, rain.radii[rain.next]};
    bool placed = false;
    for (int t = 0; t < tries && !placed; ++t) {
      for (int axis = 0; axis < 3; ++axis) {
        ball.position[axis] =
            rain.random.uniform(rain.box.lo[axis] + ball.radius, rain.box.hi[axis] - ball.radius);
      }
      placed = crowd.has_room(ball) && clear_of_walls(sim, ball);
    }
    if (!placed) break;
    crowd.add(ball);
    added.push_back({ball.position, ball.radius, rain.velocity, {0, 0, 0}, rain.material, rain.layer});
  }
  sim.add_grains(added);
  return added.size();
}

}  // namespace interstice::dem
