// ParaView's .pvd: a list of files with their times.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "coupling/io/atomic_file.h"
#include "coupling/io/vti_file.h"

namespace interstice::io {
namespace {

// The text between NAME=" and the next quote.
std::string attribute(const std::string& line, const std::string& name) {
  const auto at = line.find(name + "=\"");
  if (at == std::string::npos) return {};
  const auto from = at + name.size() + 2;
  const auto to = line.find('"', from);
  return to == std::string::npos ? std::string() : line.substr(from, to - from);
}

}  // namespace

std::vector<PvdEntry> read_pvd(const std::filesystem::path& path) {
  std::vector<PvdEntry> entries;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line.find("<DataSet ") == std::string::npos) continue;
    PvdEntry entry;
    const std::string time = attribute(line, "timestep");
    entry.file = attribute(line, "file");
    const auto [end, error] = std::from_chars(time.data(), time.data() + time.size(), entry.time);
    if (error == std::errc() && end == time.data() + time.size() && !entry.file.empty())
      entries.push_back(entry);
  }
  return entries;
}

void write_pvd(const std::filesystem::path& path, std::vector<PvdEntry> entries) {
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n";
  for (const auto& entry : entries) {
    xml += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  }
  write_text_atomically(path, xml + "  </Collection>\n</VTKFile>\n");
}

void append_to_pvd(const std::filesystem::path& path, const PvdEntry& entry) {
  auto entries = read_pvd(path);
  entries.erase(
      std::remove_if(entries.begin(), entries.end(), [&](const auto& e) { return e.file == entry.file; }),
      entries.end());
  entries.push_back(entry);
  write_pvd(path, std::move(entries));
}

}  // namespace interstice::io
