// A CSV file that grows by a row at a time. A kill loses at most the row in progress; going on drops what
// came later than the checkpoint, and a row cut short.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

namespace interstice::stream {

class GrowingTable {
 public:
  /// Starts a new file, or (keep_until given) continues one: rows whose number in column `time_column` is
  /// later than that [s] are dropped. Throws InputError when the present file has another header, RunError
  /// when it cannot write.
  GrowingTable(std::filesystem::path path, const std::string& header, std::optional<double> keep_until = {},
               int time_column = 0);

  void append(const std::string& row);

 private:
  std::filesystem::path path_;
  std::ofstream out_;
};

}  // namespace interstice::stream
