#include "coupling/io/particle_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "coupling/io/columns.h"
#include "coupling/io/dump_reader.h"
#include "coupling/io/edem_csv_reader.h"
#include "coupling/io/edem_hdf5_reader.h"
#include "coupling/io/mercury_reader.h"
#include "coupling/io/table_reader.h"
#include "coupling/io/text_lines.h"
#include "coupling/io/trajectory_adapter.h"
#include "coupling/io/vtk_legacy_reader.h"
#include "coupling/io/vtk_xml_reader.h"

namespace interstice::io {
namespace {

constexpr std::size_t most_warnings = 20;  // a file of a million odd frames says so in a few lines

// The file's first bytes, through gzip where it is.
std::string head_of(const std::filesystem::path& path) {
  TextLines lines(path);  // for its messages when the file cannot be opened
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) return {};
  std::string head(4096, '\0');
  const int got = gzread(file, head.data(), static_cast<unsigned>(head.size()));
  gzclose_r(file);
  head.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return head;
}

bool begins(const std::string& head, std::string_view with) {
  return head.compare(0, with.size(), with) == 0;
}

// Of a file named run.dump.gz: ".dump".
std::string extension_of(std::filesystem::path path) {
  if (path.extension() == ".gz") path = path.stem();
  return path.extension().string();
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw InputError(fmt::format(
      "{}:1: {}; readable are trajectory.h5part, LIGGGHTS/LAMMPS text dumps, VTK (legacy, .vtp), CSV "
      "with a header, YADE text (x y z r), MercuryDPM .data, EDEM CSV and .h5, all but HDF5 also "
      "gzipped; write one of them",
      path.string(), what));
}

}  // namespace

bool ParticleReader::skip() {
  ParticleFrame frame;
  return next(frame);
}

void ParticleReader::warn(const std::string& line) {
  if (warnings_.size() > most_warnings ||
      std::find(warnings_.begin(), warnings_.end(), line) != warnings_.end())
    return;
  warnings_.push_back(warnings_.size() < most_warnings ? line : "further warnings of this file are left out");
}

void ParticleReader::check_sizes(const ParticleFrame& frame, const std::filesystem::path& path) {
  if (frame.radius.empty() || sizes_warned_) return;
  const auto [least, most] = std::minmax_element(frame.radius.begin(), frame.radius.end());
  if (*most <= 0.1 && *least >= 1e-9) return;
  sizes_warned_ = true;
  warn(fmt::format(
      "{}: radii from {:.3g} m to {:.3g} m are no powder's; 1e-9 m to 0.1 m expected; give the file's unit "
      "with --length-unit (um, mm, ...)",
      path.string(), *least, *most));
}

void ParticleReader::finish(ParticleFrame& frame, const std::string& where,
                            const std::filesystem::path& path) {
  if (const auto repeated = sort_by_id(frame); repeated > 0) {
    warn(fmt::format("{}: {} ids occur more than once; every row counts as a grain", where, repeated));
  }
  check_sizes(frame, path);
}

std::unique_ptr<ParticleReader> open_particles(const std::filesystem::path& path,
                                               const ReaderOptions& options) {
  const std::string head = head_of(path);
  if (head.empty()) refuse(path, "the file is empty");
  const std::string extension = extension_of(path);
  if (begins(head, "\x89HDF\r\n\x1a\n")) {
    // by name first: a trajectory may have a journal, and is not to be opened without it
    if (extension != ".h5part" && looks_like_edem_hdf5(path)) return open_edem_hdf5(path, options);
    return open_trajectory(path, options);
  }
  const auto first = head.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && head.compare(first, 5, "ITEM:") == 0) return open_dump(path, options);
  if (begins(head, "# vtk DataFile")) return open_vtk_legacy(path, options);
  if (head.find("<VTKFile") != std::string::npos) return open_vtk_xml(path, options);
  if (begins(head, "<?xml")) refuse(path, "XML, but not VTK's");
  if (extension == ".h5part" || extension == ".h5") refuse(path, "named as HDF5, but its content is none");
  if (extension == ".dump" || extension == ".lammpstrj")
    refuse(path, "named as a dump, but no ITEM: line begins it");
  if (head.find('\0') != std::string::npos) refuse(path, "binary content of no known kind");
  if (head.find(" atoms") != std::string::npos && head.find("xlo xhi") != std::string::npos) {
    refuse(path, "LAMMPS data files are not read in this version");
  }
  if (looks_like_mercury(head)) return open_mercury(path, options);
  if (looks_like_edem_csv(head)) return open_edem_csv(path, options);
  return open_table(path, options);
}

}  // namespace interstice::io
