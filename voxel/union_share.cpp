#include "voxel/union_share.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "voxel/quadrature.h"

namespace interstice::voxel {

namespace {

struct Disc {
  double x, y, square, radius;

  double half(double at) const {  // half the chord at height y = at
    const double d = at - y;
    return std::sqrt(std::max(0.0, square - d * d));
  }
  /// The area between x = 0 of the disc's own middle line and its right arc, below height `at`.
  double primitive(double at) const {
    const double d = std::clamp(at - y, -radius, radius);
    return 0.5 * (d * std::sqrt(std::max(0.0, square - d * d)) + square * std::asin(d / radius));
  }
};

/// One end of an interval: an arc (side -1 or 1 of a disc) or an edge of the cell.
struct End {
  double at = 0;  // in the middle of the strip
  int disc = -1, side = 0;
};

struct Interval {
  End left, right;
};

struct Scratch {
  std::vector<Disc> discs;
  std::vector<double> events;
  std::vector<Interval> intervals;
};

void add_event(double y, std::vector<double>& events) {
  if (y > 0 && y < 1) events.push_back(y);
}

void find_events(const std::vector<Disc>& discs, std::vector<double>& events) {
  events.assign({0.0, 1.0});
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& a = discs[i];
    add_event(a.y - a.radius, events);
    add_event(a.y + a.radius, events);
    for (const double edge : {0.0, 1.0}) {
      const double square = a.square - (edge - a.x) * (edge - a.x);
      if (square <= 0) continue;
      add_event(a.y - std::sqrt(square), events);
      add_event(a.y + std::sqrt(square), events);
    }
    for (std::size_t j = i + 1; j < discs.size(); ++j) {
      const Disc& b = discs[j];
      const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
      if (squared <= 0) continue;
      const double t = 0.5 * (1 + (a.square - b.square) / squared);  // of the way from a to b
      const double height = a.square / squared - t * t;
      if (height <= 0) continue;
      const double across = std::sqrt(height) * dx;
      add_event(a.y + t * dy - across, events);
      add_event(a.y + t * dy + across, events);
    }
  }
  std::sort(events.begin(), events.end());
}

/// The area right of x = 0 and left of an end, from y = lo to y = hi.
double area_left_of(const End& end, const std::vector<Disc>& discs, double lo, double hi) {
  if (end.disc < 0) return end.at * (hi - lo);
  const Disc& disc = discs[static_cast<std::size_t>(end.disc)];
  return disc.x * (hi - lo) + end.side * (disc.primitive(hi) - disc.primitive(lo));
}

void find_intervals(const std::vector<Disc>& discs, double middle, std::vector<Interval>& intervals) {
  intervals.clear();
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    if (std::abs(middle - disc.y) >= disc.radius) continue;
    const double half = disc.half(middle), lo = disc.x - half, hi = disc.x + half;
    if (lo >= 1 || hi <= 0) continue;
    const int own = static_cast<int>(i);
    intervals.push_back(
        {lo > 0 ? End{lo, own, -1} : End{0.0, -1, 0}, hi < 1 ? End{hi, own, 1} : End{1.0, -1, 0}});
  }
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return a.left.at < b.left.at; });
}

double shared_strip(Scratch& s, double lo, double hi) {
  find_intervals(s.discs, 0.5 * (lo + hi), s.intervals);
  if (s.intervals.size() < 2) return 0;
  double area = 0;
  End covered = s.intervals[0].right;  // how far the union reaches
  for (std::size_t i = 1; i < s.intervals.size(); ++i) {
    const Interval& next = s.intervals[i];
    const bool beyond = next.right.at > covered.at;
    if (next.left.at < covered.at)
      area += area_left_of(beyond ? covered : next.right, s.discs, lo, hi) -
              area_left_of(next.left, s.discs, lo, hi);
    if (beyond) covered = next.right;
  }
  return area;
}

constexpr double kNoise = 1e-13;  // of a cell: finer than this is rounding of areas

/// How far a lens reaches along an axis: to the top of one ball where that lies in the other, else to its
/// rim.
double top(const CellBall& a, const CellBall& b, const Lens& lens, const Vec3d& normal, int axis,
           double side) {
  for (const auto& [ball, other] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    Vec3d at = ball->center;
    at[axis] += side * ball->radius;
    const Vec3d from = at - other->center;
    if (dot(from, from) <= other->radius * other->radius) return at[axis];
  }
  const double tilt = std::sqrt(std::max(0.0, 1 - normal[axis] * normal[axis]));
  return lens.rim_center[axis] + side * lens.rim_radius * tilt;
}

}  // namespace

double shared_area(const std::vector<CellBall>& balls, double z) {
  thread_local Scratch s;
  s.discs.clear();
  for (const CellBall& ball : balls) {
    const double dz = z - ball.center.z, square = ball.radius * ball.radius - dz * dz;
    if (square <= 0) continue;
    const double radius = std::sqrt(square);
    if (ball.center.x - radius >= 1 || ball.center.x + radius <= 0) continue;
    if (ball.center.y - radius >= 1 || ball.center.y + radius <= 0) continue;
    s.discs.push_back({ball.center.x, ball.center.y, square, radius});
  }
  if (s.discs.size() < 2) return 0;
  find_events(s.discs, s.events);
  double area = 0;
  for (std::size_t e = 0; e + 1 < s.events.size(); ++e)
    if (s.events[e + 1] > s.events[e]) area += shared_strip(s, s.events[e], s.events[e + 1]);
  return area;
}

double shared_volume(const std::vector<CellBall>& balls, double lo, double hi, double tolerance) {
  lo = std::max(lo, 0.0), hi = std::min(hi, 1.0);
  if (balls.size() < 2 || lo >= hi) return 0;
  return integrate([&](double z) { return shared_area(balls, z); }, lo, hi, tolerance, kNoise);
}

double shared_volume_by_lines(const std::vector<CellBall>& balls, int points) {
  std::vector<std::pair<double, double>> intervals;
  double sum = 0;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      const double x = (i + 0.5) / points, y = (j + 0.5) / points;
      intervals.clear();
      for (const CellBall& ball : balls) {
        const double dx = x - ball.center.x, dy = y - ball.center.y;
        const double square = ball.radius * ball.radius - dx * dx - dy * dy;
        if (square <= 0) continue;
        const double half = std::sqrt(square);
        const double lo = std::max(ball.center.z - half, 0.0), hi = std::min(ball.center.z + half, 1.0);
        if (lo < hi) intervals.emplace_back(lo, hi);
      }
      std::sort(intervals.begin(), intervals.end());
      double covered = 0;
      for (const auto& [lo, hi] : intervals) {
        sum += std::max(0.0, std::min(covered, hi) - lo);
        covered = std::max(covered, hi);
      }
    }
  return sum / points / points;
}

Meeting meeting(const CellBall& a, const CellBall& b) {
  const double d = norm(b.center - a.center);
  if (d >= a.radius + b.radius) return Meeting::apart;
  if (d <= b.radius - a.radius) return Meeting::first_inside;
  if (d <= a.radius - b.radius) return Meeting::second_inside;
  return Meeting::lens;
}

Lens lens_of(const CellBall& a, const CellBall& b) {
  const Vec3d between = b.center - a.center;
  const double d = norm(between), ra = a.radius, rb = b.radius, gap = ra + rb - d;
  const Vec3d normal = (1 / d) * between;
  Lens lens;
  lens.volume =
      std::numbers::pi * gap * gap * (d * d + 2 * d * (ra + rb) - 3 * (ra - rb) * (ra - rb)) / (12 * d);
  const double t = 0.5 * (d + (ra - rb) * (ra + rb) / d);  // from a's centre to the rim's plane
  lens.rim_center = a.center + t * normal;
  lens.rim_radius = std::sqrt(std::max(0.0, (ra - t) * (ra + t)));
  // a cap that is more than half a ball is as wide as the ball
  const double depth = std::max(ra - t, rb - (d - t));
  lens.outer_radius = std::max(lens.rim_radius, depth);
  if (t < 0) lens.outer_radius = std::max(lens.outer_radius, ra + std::abs(t));
  if (d - t < 0) lens.outer_radius = std::max(lens.outer_radius, rb + std::abs(d - t));
  for (int axis = 0; axis < 3; ++axis) {
    lens.lo[axis] = top(a, b, lens, normal, axis, -1);
    lens.hi[axis] = top(a, b, lens, normal, axis, 1);
  }
  return lens;
}

}  // namespace interstice::voxel
