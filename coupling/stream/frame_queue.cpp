#include "coupling/stream/frame_queue.h"

#include <new>

#include "base/error.h"

namespace interstice::stream {

struct FrameQueue::Source {
  QueuedInput input;
  std::size_t index = 0;  // in the list
  std::size_t given = 0;  // how many of the wanted frames are handed out
  bool busy = false;      // a worker is reading it
  std::int64_t at = 0;    // the frame that the reader comes to next
  std::unique_ptr<io::ParticleReader> reader;

  bool exhausted() const { return given == input.frames.size(); }
};

InputScan scan_input(const std::filesystem::path& path, const io::ReaderOptions& options) {
  InputScan scan;
  try {
    const auto reader = io::open_particles(path, options);
    scan.kind = reader->kind();
    if (reader->frames() >= 0) {
      scan.frames = reader->frames();
    } else {
      while (reader->skip()) ++scan.frames;
    }
    if (scan.frames == 0) {
      scan.broken = path.string() + ": no frames; at least one is needed; check the file";
    }
  } catch (const std::bad_alloc&) {
    scan.broken = path.string() + ": too large for this machine's memory";
  } catch (const std::exception& error) {
    scan.broken = error.what();
  }
  return scan;
}

FrameQueue::FrameQueue(std::vector<QueuedInput> inputs, io::ReaderOptions options)
    : options_(std::move(options)) {
  for (auto& input : inputs) {
    auto source = std::make_unique<Source>();
    source->input = std::move(input);
    source->index = sources_.size();
    sources_.push_back(std::move(source));
  }
}

FrameQueue::~FrameQueue() = default;

FrameQueue::Source* FrameQueue::free_source() {
  while (first_open_ < sources_.size() && sources_[first_open_]->exhausted()) ++first_open_;
  for (std::size_t i = first_open_; i < sources_.size(); ++i) {
    if (!sources_[i]->busy && !sources_[i]->exhausted()) return sources_[i].get();
  }
  return nullptr;
}

std::optional<QueuedFrame> FrameQueue::next() {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stopped_) return std::nullopt;
    Source* source = free_source();
    if (source == nullptr && first_open_ == sources_.size()) return std::nullopt;
    if (source == nullptr) {
      changed_.wait(lock);
      continue;
    }
    source->busy = true;
    lock.unlock();
    QueuedFrame frame = read(*source);
    lock.lock();
    source->busy = false;
    if (source->reader && (source->exhausted() || !frame.error.empty())) {
      const auto& odd = source->reader->warnings();
      warnings_.insert(warnings_.end(), odd.begin(), odd.end());
    }
    // Behind an error a reader may stand anywhere: the next frame begins with a new one.
    if (source->exhausted() || !frame.error.empty()) source->reader.reset();
    changed_.notify_all();
    return frame;
  }
}

QueuedFrame FrameQueue::read(Source& source) {
  QueuedFrame result;
  result.input = source.index;
  result.number = source.input.frames[source.given];
  try {
    if (!source.reader) {
      source.reader = io::open_particles(source.input.path, options_);
      source.at = 0;
    }
    bool more = true;
    while (more && source.at < result.number) {
      more = source.reader->skip();
      ++source.at;
    }
    more = more && source.reader->next(result.frame);
    result.position_resolution = source.reader->position_resolution();
    ++source.at;
    if (!more) result.error = source.input.path.string() + ": changed while it was read; run again";
  } catch (const std::bad_alloc&) {
    result.error = source.input.path.string() + ": too large for this machine's memory";
  } catch (const std::exception& error) {
    result.error = error.what();
  }
  ++source.given;
  return result;
}

void FrameQueue::stop() {
  const std::lock_guard guard(mutex_);
  stopped_ = true;
  changed_.notify_all();
}

std::vector<std::string> FrameQueue::take_warnings() {
  const std::lock_guard guard(mutex_);
  for (const auto& source : sources_) {
    if (!source->reader) continue;
    const auto& odd = source->reader->warnings();
    warnings_.insert(warnings_.end(), odd.begin(), odd.end());
  }
  return std::move(warnings_);
}

}  // namespace interstice::stream
