// Frames of many particle files, handed out to many workers: each input is read by one worker at a time,
// several inputs at once, and no more frames are in memory than there are workers.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "coupling/io/particle_reader.h"

namespace interstice::stream {

/// What a first look at an input found, without reading its numbers where the kind allows that.
struct InputScan {
  std::string kind;
  std::int64_t frames = 0;  // that are whole
  std::string broken;       // why the file cannot be read behind these; empty where it can
};
InputScan scan_input(const std::filesystem::path& path, const io::ReaderOptions& options);

struct QueuedInput {
  std::filesystem::path path;
  std::vector<std::int64_t> frames;  // wanted, rising
};

/// A frame, or why it could not be read.
struct QueuedFrame {
  std::size_t input = 0;
  std::int64_t number = 0;
  io::ParticleFrame frame;
  double position_resolution = 0;  // [m], as its reader says
  std::string error;
};

class FrameQueue {
 public:
  FrameQueue(std::vector<QueuedInput> inputs, io::ReaderOptions options);
  ~FrameQueue();

  /// The next frame of the first input that no other worker is reading; waits where all are being read.
  /// Nothing when all frames are handed out, or after stop(). A frame that cannot be read costs only itself.
  std::optional<QueuedFrame> next();

  /// No more frames are handed out.
  void stop();

  /// What readers found odd: to be called when the workers are done.
  std::vector<std::string> take_warnings();

 private:
  struct Source;
  Source* free_source();
  QueuedFrame read(Source& source);

  io::ReaderOptions options_;
  std::vector<std::unique_ptr<Source>> sources_;
  std::vector<std::string> warnings_;
  std::size_t first_open_ = 0;  // all sources before it are exhausted
  bool stopped_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace interstice::stream
