#include "coupling/stream/field_stream.h"

#include <chrono>

namespace interstice::stream {
namespace {
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}
}  // namespace

FieldStream::FieldStream(std::function<void(const Snapshot&)> work)
    : work_(std::move(work)), thread_([this] { loop(); }) {}

FieldStream::~FieldStream() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

Snapshot& FieldStream::acquire() {
  const auto start = Clock::now();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return slots_[fill_] == Slot::free || failure_; });
  wait_seconds_ += seconds_since(start);
  rethrow();
  slots_[fill_] = Slot::filling;
  snapshots_[fill_] = {};
  return snapshots_[fill_];
}

void FieldStream::submit() {
  {
    const std::lock_guard lock(mutex_);
    slots_[fill_] = Slot::full;
    fill_ = 1 - fill_;
  }
  changed_.notify_all();
}

void FieldStream::finish() {
  const auto start = Clock::now();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return all_done(); });
  wait_seconds_ += seconds_since(start);
  rethrow();
}

bool FieldStream::idle() const {
  const std::lock_guard lock(mutex_);
  return all_done();
}

bool FieldStream::all_done() const {
  return failure_ || (slots_[0] != Slot::full && slots_[0] != Slot::working && slots_[1] != Slot::full &&
                      slots_[1] != Slot::working);
}

double FieldStream::work_seconds() const {
  const std::lock_guard lock(mutex_);
  return work_seconds_;
}

void FieldStream::rethrow() {
  if (failure_) std::rethrow_exception(failure_);
}

void FieldStream::loop() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return slots_[drain_] == Slot::full || closing_; });
    if (slots_[drain_] != Slot::full) return;
    slots_[drain_] = Slot::working;
    lock.unlock();
    const auto start = Clock::now();
    std::exception_ptr failure;
    try {
      work_(snapshots_[drain_]);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    work_seconds_ += seconds_since(start);
    slots_[drain_] = Slot::free;
    drain_ = 1 - drain_;
    if (failure && !failure_) failure_ = failure;
    changed_.notify_all();
  }
}

}  // namespace interstice::stream
