#include "dem/rain.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "dem/wall_distance.h"

namespace interstice::dem {
namespace {

struct Ball {
  Vec3d position;
  double radius;
};

/// Balls by cell, for asking whether a new one overlaps any.
class Crowd {
 public:
  Crowd(const Box& box, double largest) : lo_(box.lo), cell_(2 * largest) {}

  void add(const Ball& ball) { cells_[key(ball.position)].push_back(ball); }

  bool has_room(const Ball& ball) const {
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const Vec3d at = ball.position + cell_ * Vec3d{double(i), double(j), double(k)};
          const auto it = cells_.find(key(at));
          if (it == cells_.end()) continue;
          for (const Ball& other : it->second) {
            const Vec3d apart = ball.position - other.position;
            const double reach = ball.radius + other.radius;
            if (dot(apart, apart) <= reach * reach) return false;
          }
        }
      }
    }
    return true;
  }

 private:
  std::uint64_t key(const Vec3d& p) const {
    std::uint64_t k = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto c = static_cast<std::int64_t>(std::floor((p[axis] - lo_[axis]) / cell_)) + (1 << 20);
      k = k << 21 | (static_cast<std::uint64_t>(c) & 0x1fffff);
    }
    return k;
  }
  Vec3d lo_;
  double cell_;
  std::unordered_map<std::uint64_t, std::vector<Ball>> cells_;
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
  for (const GrainRow& g : sim.rows()) largest = std::max(largest, g.radius);
  Crowd crowd(rain.box, largest);
  for (const GrainRow& g : sim.rows()) {
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
