// Fields while the simulation goes on: the run copies its columns into one of two buffers and steps on;
// another thread turns the buffer into fields and files. The run waits only when both buffers are full.
#pragma once

#include <array>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "coupling/io/particle_frame.h"

namespace interstice::stream {

/// One moment of the run, copied out of the particle store.
struct Snapshot {
  io::ParticleFrame frame;
  std::string phase;
  bool phase_end = false;
  struct Due {
    std::size_t field;    // index in the scene
    std::int64_t number;  // of its frame
  };
  std::vector<Due> due;  // fields to compute at this moment
};

class FieldStream {
 public:
  explicit FieldStream(std::function<void(const Snapshot&)> work);
  ~FieldStream();  // finishes what was submitted; errors are lost, so call finish() first
  FieldStream(const FieldStream&) = delete;
  FieldStream& operator=(const FieldStream&) = delete;

  /// A buffer to fill; waits while both are in use. Rethrows what the work threw.
  Snapshot& acquire();
  /// Hands the acquired buffer over.
  void submit();
  /// Waits until all is done. Rethrows what the work threw.
  void finish();
  /// Would finish() return at once?
  bool idle() const;

  double work_seconds() const;                           // spent by the other thread
  double wait_seconds() const { return wait_seconds_; }  // spent by the run, waiting

 private:
  enum class Slot { free, filling, full, working };
  void loop();
  bool all_done() const;
  void rethrow();

  std::function<void(const Snapshot&)> work_;
  std::array<Snapshot, 2> snapshots_;
  std::array<Slot, 2> slots_{Slot::free, Slot::free};
  std::size_t fill_ = 0;  // buffers are used in turn, so frames are written in order
  std::size_t drain_ = 0;
  bool closing_ = false;
  std::exception_ptr failure_;
  double work_seconds_ = 0, wait_seconds_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace interstice::stream
