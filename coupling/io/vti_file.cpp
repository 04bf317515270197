#include "coupling/io/vti_file.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/error.h"
#include "base/parallel.h"
#include "coupling/io/atomic_file.h"

namespace interstice::io {
namespace {

constexpr std::int64_t block_cells = std::int64_t{1} << 16;  // about 256 kB a block

/// One array of the file as VTK wants it appended: a header of sizes, then the compressed blocks.
struct Appended {
  std::string name;
  std::size_t components = 1;
  std::vector<std::uint64_t>
      header;  // blocks, bytes a block, bytes of the last where it is shorter, compressed bytes
  std::vector<std::string> blocks;

  std::uint64_t bytes() const {
    std::uint64_t total = header.size() * sizeof(std::uint64_t);
    for (const auto& block : blocks) total += block.size();
    return total;
  }
};

// Do fewer than half of the values repeat the one before (of the same component)? Then there is little to
// gain: of a dense bed's fractions zlib takes a fifth in ten times the time that copying needs.
bool hardly_repeats(const std::vector<float>& values, std::size_t components) {
  std::size_t repeats = 0;
  for (std::size_t i = components; i < values.size(); ++i) repeats += values[i] == values[i - components];
  return 2 * repeats < values.size();
}

// As zlib has it: copied, or by runs and entropy only, which on fractions is a tenth larger than zlib's usual
// search for matches, and near twice as fast.
std::string deflated(std::vector<float>& values, std::size_t components) {
  const int level = hardly_repeats(values, components) ? Z_NO_COMPRESSION : Z_BEST_SPEED;
  z_stream stream{};
  constexpr int window = 15, memory = 8;  // with memory 9, deflateBound is too small for a few copied bytes
  if (deflateInit2(&stream, level, Z_DEFLATED, window, memory, Z_RLE) != Z_OK) {
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

using Components = std::vector<const openvdb::FloatGrid*>;

// The cells of some z layers, all components of a cell side by side.
std::vector<float> dense_layers(const Components& grids, const openvdb::CoordBBox& box) {
  using Dense = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;  // x fastest, as VTK has it
  const std::size_t cells = box.volume(), components = grids.size();
  std::vector<float> all(cells * components), one(components > 1 ? cells : 0);
  for (std::size_t c = 0; c < components; ++c) {
    Dense dense(box, components > 1 ? one.data() : all.data());
    openvdb::tools::copyToDense(*grids[c], dense, /*serial=*/true);
    for (std::size_t i = 0; i < one.size(); ++i) all[i * components + c] = one[i];
  }
  return all;
}

// A block is a number of whole z layers, so that each is copied out of the sparse grids and compressed by
// itself.
Appended compressed(const Components& grids, const std::array<std::int64_t, 3>& n) {
  const std::int64_t layer = n[0] * n[1] * static_cast<std::int64_t>(grids.size());
  const Blocks layers{static_cast<std::size_t>(n[2]),
                      static_cast<std::size_t>(std::max<std::int64_t>(1, block_cells / layer))};
  Appended array;
  array.blocks.resize(layers.count());
  for_each_block(layers, [&](std::size_t b, std::size_t begin, std::size_t end) {
    const openvdb::CoordBBox box(0, 0, static_cast<int>(begin), static_cast<int>(n[0] - 1),
                                 static_cast<int>(n[1] - 1), static_cast<int>(end) - 1);
    std::vector<float> values = dense_layers(grids, box);
    array.blocks[b] = deflated(values, grids.size());
  });
  const auto layer_bytes = static_cast<std::uint64_t>(layer) * sizeof(float);
  const std::uint64_t last =
      (layers.end(layers.count() - 1) - layers.begin(layers.count() - 1)) * layer_bytes;
  const std::uint64_t full = layers.count() == 1 ? last : layers.block * layer_bytes;
  array.header = {layers.count(), full, last == full ? 0 : last};
  for (const auto& block : array.blocks) array.header.push_back(block.size());
  return array;
}

std::string opening(const voxel::Field& field, double time, const std::vector<Appended>& arrays) {
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
  for (const auto& array : arrays) {
    const std::string components =
        array.components > 1 ? fmt::format("NumberOfComponents=\"{}\" ", array.components) : "";
    xml +=
        fmt::format("        <DataArray type=\"Float32\" Name=\"{}\" {}format=\"appended\" offset=\"{}\"/>\n",
                    array.name, components, offset);
    offset += array.bytes();
  }
  return xml + "      </CellData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_";
}

}  // namespace

void write_vti(const std::filesystem::path& path, const voxel::Field& field, double time) {
  std::vector<Appended> arrays;
  const auto add_all = [&](const Components& grids, const std::string& name) {
    arrays.push_back(compressed(grids, field.lattice.n));
    arrays.back().name = name;
    arrays.back().components = grids.size();
  };
  const auto add = [&](const openvdb::FloatGrid::Ptr& grid, const char* name) {
    if (grid) add_all({grid.get()}, name);
  };
  add(field.void_fraction, "void_fraction");
  add(field.solid_fraction, "solid_fraction");
  add(field.available_fraction, "available_fraction");
  add(field.void_fraction_averaged, "void_fraction_averaged");
  add(field.solid_fraction_averaged, "solid_fraction_averaged");
  for (auto first = field.quantities.begin(); first != field.quantities.end();) {
    const auto last =
        std::find_if(first, field.quantities.end(), [&](const auto& q) { return q.name != first->name; });
    Components grids, averaged;
    for (auto q = first; q != last; ++q) {
      grids.push_back(q->grid.get());
      if (q->averaged) averaged.push_back(q->averaged.get());
    }
    add_all(grids, first->name);
    if (!averaged.empty()) add_all(averaged, first->name + "_averaged");
    first = last;
  }
  write_atomically(path, [&](const std::filesystem::path& aside) {
    std::ofstream out(aside, std::ios::binary);
    out << opening(field, time, arrays);
    for (const auto& array : arrays) {
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
