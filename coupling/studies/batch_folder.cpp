#include "coupling/studies/batch_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>

#include "base/error.h"
#include "coupling/io/atomic_file.h"
#include "coupling/studies/table.h"

namespace interstice::studies {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Cells = std::vector<std::pair<std::string, std::string>>;

constexpr const char* manifest_name = "batch.json";
constexpr const char* table_name = "table.csv";
constexpr const char* lock_name = ".batch.lock";
constexpr const char* format_name = "interstice-batch";

std::optional<Json> read_json(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  Json json = Json::parse(in, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  return json;
}

[[noreturn]] void other_results(const fs::path& folder, const std::string& what) {
  throw InputError(
      fmt::format("{}: holds results of {}; the same inputs and options continue a batch; use "
                  "--overwrite to replace them, or another -o",
                  folder.string(), what));
}

/// A folder counts as empty when all in it is what a killed call leaves before its manifest is there.
bool holds_nothing(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != lock_name && !name.starts_with(fmt::format(".{}.tmp-", manifest_name))) return false;
  }
  return true;
}

std::string absolute_name(const fs::path& path) { return fs::absolute(path).lexically_normal().string(); }

/// "box_m" of six numbers becomes box_x0_m, box_x1_m, ...: the unit stays last.
std::string element_name(const std::string& key, std::size_t size, std::size_t i) {
  static const std::array<const char*, 6> bounds{"x0", "x1", "y0", "y1", "z0", "z1"};
  static const std::array<const char*, 3> axes{"x", "y", "z"};
  const bool metres = key.ends_with("_m");
  const std::string stem = metres ? key.substr(0, key.size() - 2) : key;
  const std::string index = size == 6 ? bounds[i] : size == 3 ? axes[i] : fmt::format("{}", i);
  return fmt::format("{}_{}{}", stem, index, metres ? "_m" : "");
}

std::string number_cell(const Json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (value.is_number_integer()) return value.dump();
  return value.is_number() ? csv_cell(value.get<double>()) : std::string();
}

void add_cells(Cells& cells, const std::string& key, const Json& value) {
  if (value.is_number() || value.is_boolean() || value.is_null()) {
    cells.emplace_back(key, number_cell(value));
  } else if (value.is_array() && key == "lines") {
    for (const auto& line : value) {
      const std::string name = line.value("name", "");
      for (const auto& [inner, number] : line.items()) {
        if (inner != "name") cells.emplace_back(fmt::format("{} {}", name, inner), number_cell(number));
      }
    }
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (value[i].is_number() || value[i].is_boolean())
        cells.emplace_back(element_name(key, value.size(), i), number_cell(value[i]));
    }
  }
}

std::string line_of(const std::vector<std::string>& columns, const Cells& cells) {
  std::string line;
  for (const auto& column : columns) {
    const auto cell = std::find_if(cells.begin(), cells.end(), [&](auto& c) { return c.first == column; });
    if (!line.empty()) line += ',';
    if (cell != cells.end()) line += cell->second;
  }
  line += '\n';
  return line;
}

std::string header_of(const std::vector<std::string>& columns) {
  std::string line;
  for (const auto& column : columns) line += fmt::format("{}{}", line.empty() ? "" : ",", csv_cell(column));
  line += '\n';
  return line;
}

}  // namespace

BatchInput batch_input(const fs::path& path, const std::string& stem) {
  BatchInput input{path, stem, -1, 0};
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0 || !S_ISREG(about.st_mode)) return input;
  input.size = about.st_size;
  input.modified_ns = std::int64_t{about.st_mtim.tv_sec} * 1'000'000'000 + about.st_mtim.tv_nsec;
  return input;
}

std::vector<std::string> batch_stems(const fs::path& folder) {
  std::vector<std::string> stems;
  const auto manifest = read_json(folder / manifest_name);
  if (!manifest || !manifest->is_object() || !manifest->contains("inputs")) return stems;
  for (const auto& input : (*manifest)["inputs"]) {
    const fs::path stem = input.is_object() ? input.value("folder", "") : std::string();
    // Plain names only: what the file says is used to remove folders.
    if (!stem.empty() && stem == stem.filename() && stem != "." && stem != "..") stems.push_back(stem);
  }
  return stems;
}

BatchFolder::BatchFolder(fs::path folder, BatchSetup setup)
    : folder_(std::move(folder)), setup_(std::move(setup)) {
  std::error_code error;
  if (fs::exists(folder_, error) && !fs::is_directory(folder_, error)) {
    throw InputError(
        fmt::format("{}: is a file, not a folder; name another folder with -o", folder_.string()));
  }
  auto manifest = read_json(folder_ / manifest_name);
  if (manifest && (!manifest->is_object() || manifest->value("format", "") != format_name)) manifest.reset();
  if (manifest) {
    check_same(*manifest);
  } else if (!setup_.overwrite && fs::is_directory(folder_, error) && !holds_nothing(folder_)) {
    other_results(folder_, "something else");
  }
  fs::create_directories(folder_, error);
  if (error) throw RunError("cannot make the folder " + folder_.string() + ": " + error.message());
  try {
    lock_ = std::make_unique<io::PosixFile>(folder_ / lock_name, O_RDWR | O_CREAT | O_CLOEXEC);
  } catch (const std::system_error& e) {
    throw RunError(fmt::format("cannot write {}: {}", (folder_ / lock_name).string(),
                               io::system_reason(e.code().value())));
  }
  if (::flock(lock_->descriptor(), LOCK_EX | LOCK_NB) != 0) {
    throw InputError(
        folder_.string() +
        ": another call is at work in this folder; one at a time is allowed; wait for it, or use "
        "another -o");
  }
  if (manifest) {
    read_back();
    const std::string by = manifest->value("version", "");
    if (by != setup_.version && !rows_.empty()) other_version_ = by;
    for (std::size_t i = 0; i < setup_.inputs.size(); ++i) {
      const auto& was = (*manifest)["inputs"][i];
      const auto& now = setup_.inputs[i];
      const bool same = was["size"] == now.size && was["modified_ns"] == now.modified_ns;
      if (same || frames_of(i).empty()) continue;  // one that gave nothing yet may have been mended
      other_results(folder_, fmt::format("{} before it changed", now.path.string()));
    }
  }
  write_manifest({});
  rewrite_table();
}

void BatchFolder::check_same(const Json& manifest) const {
  const Json options = manifest.value("options", Json::object());
  for (const auto& [key, value] : setup_.options.items()) {
    if (options.contains(key) && options[key] == value) continue;
    other_results(folder_, fmt::format("{} {} (now {})", key,
                                       options.contains(key) ? options[key].dump() : "unset", value.dump()));
  }
  for (const auto& [key, value] : options.items()) {
    if (!setup_.options.contains(key))
      other_results(folder_, fmt::format("{} {} (now unset)", key, value.dump()));
  }
  const Json inputs = manifest.value("inputs", Json::array());
  const auto known = [&](std::size_t i) {
    return i < inputs.size() && inputs[i].is_object() && inputs[i].contains("size") &&
           inputs[i].contains("modified_ns") &&
           inputs[i].value("path", "") == absolute_name(setup_.inputs[i].path);
  };
  bool same = inputs.size() == setup_.inputs.size();
  for (std::size_t i = 0; same && i < setup_.inputs.size(); ++i) same = known(i);
  if (!same) {
    other_results(folder_, fmt::format("other inputs ({} files, now {}, or in another order)", inputs.size(),
                                       setup_.inputs.size()));
  }
}

void BatchFolder::read_back() {
  const fs::path path = folder_ / table_name;
  std::error_code error;
  if (!fs::exists(path, error) || fs::file_size(path, error) == 0) return;
  TableOptions options;
  options.text_columns = {"file", "folder"};
  options.growing = true;
  const Table table = read_table(path, options);
  if (table.rows() == 0) return;
  const auto& folders = table.texts("folder");
  const auto& frames = table.numbers("frame");
  for (std::size_t r = 0; r < table.rows(); ++r) {
    if (std::isfinite(frames[r]) && frames[r] >= 0)
      keep_found(folders[r], static_cast<std::int64_t>(frames[r]));
  }
}

// The summary is the truth; the row only says that all files of the frame, its figures too, were there.
void BatchFolder::keep_found(const std::string& place, std::int64_t number) {
  for (std::size_t i = 0; i < setup_.inputs.size(); ++i) {
    BatchFrame frame{i, number};
    if (place != place_of(frame, false) && place != place_of(frame, true)) continue;
    const auto summary = read_json(folder_ / place / "summary.json");
    if (summary && summary->is_object() && summary->contains("particles"))
      rows_[frame] = row_of(frame, place, *summary);
    return;
  }
}

fs::path BatchFolder::place_of(const BatchFrame& frame, bool one_of_many) const {
  const fs::path stem = setup_.inputs[frame.input].stem;
  return one_of_many ? stem / fmt::format("frame_{:06}", frame.number) : stem;
}

BatchFolder::Row BatchFolder::row_of(const BatchFrame& frame, const fs::path& place,
                                     const Json& summary) const {
  Row row{place, {}, NAN, -1};
  row.cells.emplace_back("file", csv_cell(setup_.inputs[frame.input].path.string()));
  row.cells.emplace_back("frame", fmt::format("{}", frame.number));
  const Json time = summary.value("time_s", Json(nullptr)), step = summary.value("step", Json(nullptr));
  if (time.is_number()) row.time = time.get<double>();
  if (step.is_number_integer()) row.step = step.get<std::int64_t>();
  add_cells(row.cells, "time_s", time);
  row.cells.emplace_back("folder", csv_cell(place.string()));
  for (const auto& [key, value] : summary.items()) {
    if (key != "frame" && key != "time_s") add_cells(row.cells, key, value);
  }
  return row;
}

void BatchFolder::finish(const BatchFrame& frame, bool one_of_many, const Json& summary) {
  const std::lock_guard guard(mutex_);
  Row row = row_of(frame, place_of(frame, one_of_many), summary);
  std::string text;
  if (columns_.empty()) {
    for (const auto& cell : row.cells) columns_.push_back(cell.first);
    text = header_of(columns_);
  }
  text += line_of(columns_, row.cells);
  append(text);
  rows_[frame] = std::move(row);
}

// Rows go to the end of the file as frames are done; a kill leaves at most a part of the last one.
void BatchFolder::append(const std::string& text) {
  const fs::path path = folder_ / table_name;
  try {
    const io::PosixFile file(path, O_WRONLY | O_CREAT | O_CLOEXEC);
    file.write(file.size(), text.data(), text.size());
    file.sync();
  } catch (const std::system_error& e) {
    throw RunError(fmt::format("cannot write {}: {}", path.string(), io::system_reason(e.code().value())));
  }
}

void BatchFolder::rewrite_table() {
  columns_.clear();
  std::set<std::string> seen;
  for (const auto& [frame, row] : rows_) {
    for (const auto& cell : row.cells) {
      if (seen.insert(cell.first).second) columns_.push_back(cell.first);
    }
  }
  std::string text = columns_.empty() ? "" : header_of(columns_);
  for (const auto& [frame, row] : rows_) text += line_of(columns_, row.cells);
  io::write_text_atomically(folder_ / table_name, text);
}

void BatchFolder::write_manifest(const std::vector<BatchFailure>& failures) const {
  Json manifest{{"format", format_name}, {"version", setup_.version}, {"options", setup_.options}};
  manifest["inputs"] = Json::array();
  for (const auto& input : setup_.inputs) {
    manifest["inputs"].push_back({{"path", absolute_name(input.path)},
                                  {"folder", input.stem},
                                  {"size", input.size},
                                  {"modified_ns", input.modified_ns}});
  }
  manifest["failed"] = Json::array();
  for (const auto& failure : failures) {
    manifest["failed"].push_back({{"path", absolute_name(setup_.inputs[failure.input].path)},
                                  {"frame", failure.frame >= 0 ? Json(failure.frame) : Json(nullptr)},
                                  {"message", failure.message}});
  }
  io::write_text_atomically(folder_ / manifest_name,
                            manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void BatchFolder::close(const std::vector<BatchFailure>& failures) {
  const std::lock_guard guard(mutex_);
  rewrite_table();
  write_manifest(failures);
}

std::vector<TimeSpaceFrame> BatchFolder::frames_of(std::size_t input) const {
  std::vector<TimeSpaceFrame> frames;
  for (auto at = rows_.lower_bound({input, 0}); at != rows_.end() && at->first.input == input; ++at) {
    const Row& row = at->second;
    frames.push_back({at->first.number, row.time, row.step, folder_ / row.place});
  }
  return frames;
}

}  // namespace interstice::studies
