// What is left of a reach is never overstated, and hardly understated: lists would fail, or be made too
// often.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "dem/path_left.h"

namespace interstice::dem {
namespace {

/// Steps of lengths spread evenly over decades, until a reach is used up: how far they went when it was said
/// to be, as a share of the reach, lane by lane alike.
double used_when_spent(double reach, double shortest, double longest, long most_steps) {
  Random random(7, 0);
  Lengths left(rounded_down(reach));
  double gone = 0;
  for (long i = 0; i < most_steps; ++i) {
    const double step = shortest * std::pow(longest / shortest, random.uniform(0, 1));
    left = path_left_after(left, Each(step * step));
    if ((left < Lengths(0)).bits() != 0) return (gone + step) / reach;
    gone += step;
    float now[kLanes];
    left.store(now);
    EXPECT_LE(static_cast<double>(now[0]), reach - gone) << "after " << i << " steps of " << step << " m";
    if (static_cast<double>(now[0]) > reach - gone) break;
  }
  return gone / reach;
}

TEST(PathLeft, IsNeverOverstatedAndLittleUnderstated) {
  EXPECT_GT(used_when_spent(4e-6, 1e-9, 1e-7, 1000000), 0.97);    // a grain that flies
  EXPECT_GT(used_when_spent(4e-8, 1e-12, 1e-11, 1000000), 0.99);  // one of a bed that settles
  EXPECT_GT(used_when_spent(1e-3, 1e-7, 1e-6, 1000000), 0.99);
}

/// Steps far below the rounding of what is left still count: 2^-22 of it is taken away each time.
TEST(PathLeft, ShrinksInStepsBelowItsRounding) {
  const double reach = 4e-8, step = 1e-17;  // a 400 millionth
  Lengths left(rounded_down(reach));
  const long steps = 3000000;
  for (long i = 0; i < steps; ++i) left = path_left_after(left, Each(step * step));
  float now[kLanes];
  left.store(now);
  EXPECT_LT(static_cast<double>(now[0]), reach - static_cast<double>(steps) * step);
  EXPECT_GT(static_cast<double>(now[0]), 0.4 * reach) << "exp(-2^-22 steps) of it is left, about half";
}

TEST(PathLeft, AGrainAtRestKeepsItsReachForMillionsOfSteps) {
  EXPECT_GT(used_when_spent(4e-8, 1e-30, 1e-29, 1000000), -1);
  Lengths left(rounded_down(4e-8));
  for (int i = 0; i < 1000000; ++i) left = path_left_after(left, Each(0));
  EXPECT_EQ((left > Lengths(3e-8)).bits(), kAllLanes);
}

TEST(PathLeft, AReachIsRoundedDown) {
  for (const double reach : {1e-9, 3.3e-8, 0.1, 7.7e-5})
    EXPECT_LE(static_cast<double>(rounded_down(reach)), reach);
}

}  // namespace
}  // namespace interstice::dem
