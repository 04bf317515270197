// In which number type forces are computed, and storage of that type.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "base/large_pages.h"
#include "dem/ask_for.h"

namespace interstice::dem {

enum class Precision {
  real64,  ///< everything in double
  mixed,   ///< positions, overlaps and motion in double; laws and forces in single
};

/// Bytes of a number in which forces are computed.
constexpr std::size_t real_bytes(Precision precision) {
  return precision == Precision::mixed ? sizeof(float) : sizeof(double);
}

/// Numbers in single or double, whichever the kernels use.
class Reals {
 public:
  explicit Reals(Precision precision) : single_(precision == Precision::mixed) {}

  /// n zeros, with little room beyond: lists change by a few percent from one to the next.
  void reset(std::size_t n) {
    if (single_) {
      reset(floats_, n);
    } else {
      reset(doubles_, n);
    }
  }
  std::size_t size() const { return floats_.size() + doubles_.size(); }
  bool empty() const { return floats_.empty() && doubles_.empty(); }
  double operator[](std::size_t i) const { return single_ ? static_cast<double>(floats_[i]) : doubles_[i]; }
  void set(std::size_t i, double value) {
    if (single_) {
      floats_[i] = static_cast<float>(value);
    } else {
      doubles_[i] = value;
    }
  }
  /// n numbers of another that holds the same type.
  void copy(std::size_t to, const Reals& other, std::size_t from, std::size_t n) {
    if (single_) {
      std::copy_n(other.floats_.data() + from, n, floats_.data() + to);
    } else {
      std::copy_n(other.doubles_.data() + from, n, doubles_.data() + to);
    }
  }
  /// Asks for the memory of n numbers.
  void ask(std::size_t i, std::size_t n = 1) const {
    if (single_) {
      ask_for(floats_.data() + i, n);
    } else {
      ask_for(doubles_.data() + i, n);
    }
  }
  /// As the kernels see it.
  void* data() { return single_ ? static_cast<void*>(floats_.data()) : doubles_.data(); }
  std::size_t bytes() const {
    return floats_.capacity() * sizeof(float) + doubles_.capacity() * sizeof(double);
  }

 private:
  template <class T>
  static void reset(LargeVector<T>& v, std::size_t n) {
    if (n > v.capacity() || n < v.capacity() / 2) {
      v = {};
      v.reserve(n + n / 16);
    }
    v.assign(n, T(0));
  }

  bool single_;
  LargeVector<float> floats_;
  LargeVector<double> doubles_;
};

}  // namespace interstice::dem
