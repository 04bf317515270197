// The folder of a batch: what was asked for (batch.json), which frames are done, and a table with a row per
// frame. Safe against a kill at any moment: the frames in progress are lost, no others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "coupling/io/posix_file.h"
#include "coupling/studies/time_space.h"

namespace interstice::studies {

struct BatchInput {
  std::filesystem::path path;    // as the user named it
  std::string stem;              // name of its folder
  std::int64_t size = -1;        // [bytes]; -1: there is no such file
  std::int64_t modified_ns = 0;  // since 1970
};
/// Size and time of modification of the file as it is now.
BatchInput batch_input(const std::filesystem::path& path, const std::string& stem);

struct BatchSetup {
  std::vector<BatchInput> inputs;
  nlohmann::ordered_json options;  // by name, as typed
  std::string version;             // of this program
  bool overwrite = false;          // other things in the folder are no reason to refuse it
};

/// A frame of an input, by the input's place in the list.
struct BatchFrame {
  std::size_t input = 0;
  std::int64_t number = 0;
  auto operator<=>(const BatchFrame&) const = default;
};

/// What went wrong with an input (`frame` -1) or with one frame of it.
struct BatchFailure {
  std::size_t input = 0;
  std::int64_t frame = -1;
  std::string message;
};

class BatchFolder {
 public:
  /// Starts a batch in `folder` or continues the same one there. Throws InputError when the folder holds
  /// something else: other inputs or options, or inputs that changed after frames of them were done; and when
  /// another process works in it.
  BatchFolder(std::filesystem::path folder, BatchSetup setup);

  bool is_finished(const BatchFrame& frame) const { return rows_.count(frame) > 0; }
  std::size_t finished() const { return rows_.size(); }
  /// The version that finished the frames found, where it is another than this one; else empty.
  const std::string& other_version() const { return other_version_; }

  /// "STEM" or, for one frame of many, "STEM/frame_000012".
  std::filesystem::path place_of(const BatchFrame& frame, bool one_of_many) const;

  /// Adds the row of a frame whose files, summary.json last, are all there. From any thread.
  void finish(const BatchFrame& frame, bool one_of_many, const nlohmann::ordered_json& summary);

  /// Puts the table into the order of inputs and frames, and the failures into batch.json.
  void close(const std::vector<BatchFailure>& failures);

  /// The finished frames of an input, in order.
  std::vector<TimeSpaceFrame> frames_of(std::size_t input) const;

 private:
  struct Row {
    std::filesystem::path place;
    std::vector<std::pair<std::string, std::string>> cells;  // column and text
    double time = 0;
    std::int64_t step = -1;
  };

  void read_back();
  void keep_found(const std::string& place, std::int64_t number);
  void check_same(const nlohmann::ordered_json& manifest) const;
  void write_manifest(const std::vector<BatchFailure>& failures) const;
  Row row_of(const BatchFrame& frame, const std::filesystem::path& place,
             const nlohmann::ordered_json& summary) const;
  void rewrite_table();
  void append(const std::string& text);

  std::filesystem::path folder_;
  BatchSetup setup_;
  std::string other_version_;
  std::unique_ptr<io::PosixFile> lock_;
  std::map<BatchFrame, Row> rows_;
  std::vector<std::string> columns_;  // of the table as it stands
  std::mutex mutex_;
};

/// The names of the inputs' folders that the manifest in `folder` lists; none where there is no manifest.
std::vector<std::string> batch_stems(const std::filesystem::path& folder);

}  // namespace interstice::studies
