// Are the grains of two runs the same to the last bit?
#pragma once

#include <gtest/gtest.h>

#include "dem/columns.h"

namespace interstice::dem::testing {

inline void expect_same_bits(const GrainColumns& a, const GrainColumns& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
  EXPECT_EQ(a.vx, b.vx);
  EXPECT_EQ(a.vy, b.vy);
  EXPECT_EQ(a.vz, b.vz);
  EXPECT_EQ(a.wx, b.wx);
  EXPECT_EQ(a.wy, b.wy);
  EXPECT_EQ(a.wz, b.wz);
}

}  // namespace interstice::dem::testing
