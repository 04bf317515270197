// How much memory work in parallel may take together: each job says what it will need and waits until there
// is room. A job larger than the whole budget runs alone.
#pragma once

#include <condition_variable>
#include <mutex>

namespace interstice::stream {

class MemoryBudget {
 public:
  explicit MemoryBudget(double bytes) : bytes_(bytes) {}

  /// A share of the budget, given back with the object.
  class Share {
   public:
    Share(MemoryBudget& budget, double bytes) : budget_(budget), bytes_(bytes) {
      std::unique_lock lock(budget_.mutex_);
      budget_.freed_.wait(lock,
                          [&] { return budget_.holders_ == 0 || budget_.taken_ + bytes_ <= budget_.bytes_; });
      budget_.taken_ += bytes_;
      ++budget_.holders_;
    }
    ~Share() {
      const std::lock_guard guard(budget_.mutex_);
      budget_.taken_ -= bytes_;
      if (--budget_.holders_ == 0) budget_.taken_ = 0;  // no rounding is left behind
      budget_.freed_.notify_all();
    }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;

   private:
    MemoryBudget& budget_;
    double bytes_;
  };

 private:
  double bytes_, taken_ = 0;
  int holders_ = 0;
  std::mutex mutex_;
  std::condition_variable freed_;
};

/// [bytes] that the machine can still give (MemAvailable), or half of all there is where it does not say.
double available_memory();

}  // namespace interstice::stream
