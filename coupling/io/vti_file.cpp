#include "coupling/io/vti_file.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <zlib.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "base/parallel.h"
#include "coupling/io/atomic_file.h"

namespace interstice::io {
namespace {

constexpr std::int64_t block_cells = std::int64_t{1} << 18;  // about 1 MB a compressed block

/// One array of the file as VTK wants it appended: a header of sizes, then the compressed blocks.
struct Appended {
  std::vector<std::uint64_t>
      header;  // blocks, bytes a block, bytes of the last where it is shorter, compressed bytes
  std::vector<std::string> blocks;

  std::uint64_t bytes() const {
    std::uint64_t total = header.size() * sizeof(std::uint64_t);
    for (const auto& block : blocks) total += block.size();
    return total;
  }
};

// Runs and entropy only: on fractions a tenth larger than zlib's usual search for matches, and near twice as
// fast.
std::string deflated(std::vector<float>& values) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 15, 9, Z_RLE) != Z_OK) {
    throw RunError("zlib cannot begin to compress a field; is memory short?");
  }
  stream.next_in = reinterpret_cast<Bytef*>(values.data());
  stream.avail_in = static_cast<uInt>(values.size() * sizeof(float));
  std::string out(deflateBound(&stream, stream.avail_in), '\0');
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int status = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw RunError("zlib cannot compress a block of a field");
  return out;
}

// A block is a number of whole z layers, so that each is copied out of the sparse grid and compressed by
// itself.
Appended compressed(const openvdb::FloatGrid& grid, const std::array<std::int64_t, 3>& n) {
  using Dense = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;  // x fastest, as VTK has it
  const std::int64_t layer = n[0] * n[1];
  const Blocks layers{static_cast<std::size_t>(n[2]),
                      static_cast<std::size_t>(std::max<std::int64_t>(1, block_cells / layer))};
  Appended array;
  array.blocks.resize(layers.count());
  for_each_block(layers, [&](std::size_t b, std::size_t begin, std::size_t end) {
    std::vector<float> values(static_cast<std::size_t>(layer) * (end - begin));
    const openvdb::CoordBBox box(0, 0, static_cast<int>(begin), static_cast<int>(n[0] - 1),
                                 static_cast<int>(n[1] - 1), static_cast<int>(end) - 1);
    Dense dense(box, values.data());
    openvdb::tools::copyToDense(grid, dense, /*serial=*/true);
    array.blocks[b] = deflated(values);
  });
  const auto layer_bytes = static_cast<std::uint64_t>(layer) * sizeof(float);
  const std::uint64_t last =
      (layers.end(layers.count() - 1) - layers.begin(layers.count() - 1)) * layer_bytes;
  const std::uint64_t full = layers.count() == 1 ? last : layers.block * layer_bytes;
  array.header = {layers.count(), full, last == full ? 0 : last};
  for (const auto& block : array.blocks) array.header.push_back(block.size());
  return array;
}

std::string opening(const voxel::Field& field, double time,
                    const std::vector<std::pair<std::string, Appended>>& arrays) {
  const auto& n = field.lattice.n;
  const auto& lo = field.lattice.lo;
  const auto& h = field.lattice.h;
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", n[0], n[1], n[2]);
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n";
  xml += fmt::format("  <ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">\n", extent,
                     lo.x, lo.y, lo.z, h.x, h.y, h.z);
  if (std::isfinite(time)) {
    xml += fmt::format(
        "    <FieldData>\n      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
        "format=\"ascii\">{}</DataArray>\n    </FieldData>\n",
        time);
  }
  xml += fmt::format("    <Piece Extent=\"{}\">\n      <CellData Scalars=\"void_fraction\">\n", extent);
  std::uint64_t offset = 0;
  for (const auto& [name, array] : arrays) {
    xml +=
        fmt::format("        <DataArray type=\"Float32\" Name=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
                    name, offset);
    offset += array.bytes();
  }
  return xml + "      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_";
}

}  // namespace

void write_vti(const std::filesystem::path& path, const voxel::Field& field, double time) {
  std::vector<std::pair<std::string, Appended>> arrays;
  const auto add = [&](const openvdb::FloatGrid::Ptr& grid, const char* name) {
    if (grid) arrays.emplace_back(name, compressed(*grid, field.lattice.n));
  };
  add(field.void_fraction, "void_fraction");
  add(field.solid_fraction, "solid_fraction");
  add(field.available_fraction, "available_fraction");
  add(field.void_fraction_averaged, "void_fraction_averaged");
  add(field.solid_fraction_averaged, "solid_fraction_averaged");
  write_atomically(path, [&](const std::filesystem::path& aside) {
    std::ofstream out(aside, std::ios::binary);
    out << opening(field, time, arrays);
    for (const auto& [name, array] : arrays) {
      out.write(reinterpret_cast<const char*>(array.header.data()),
                static_cast<std::streamsize>(array.header.size() * sizeof(std::uint64_t)));
      for (const auto& block : array.blocks)
        out.write(block.data(), static_cast<std::streamsize>(block.size()));
    }
    out << "\n  </AppendedData>\n</VTKFile>\n";
    out.close();
    if (!out) throw RunError(fmt::format("cannot write {}: the disk may be full", path.string()));
  });
}

}  // namespace interstice::io
