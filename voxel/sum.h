// A sum that keeps what rounding drops (Neumaier, Z. angew. Math. Mech. 54, 1974, 39).
#pragma once

#include <cmath>

namespace interstice::voxel {

class CompensatedSum {
 public:
  void add(double value) {
    const double sum = sum_ + value;
    lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
    sum_ = sum;
  }
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0, lost_ = 0;
};

}  // namespace interstice::voxel
