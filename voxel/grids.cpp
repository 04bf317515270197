#include "voxel/grids.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "voxel/methods.h"
#include "voxel/metre_grid.h"
#include "voxel/text.h"

namespace interstice::voxel {

namespace {

std::string box_text(const Box& box) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    text += (axis ? "," : "") + shown(box.lo[axis], 17) + "," + shown(box.hi[axis], 17);
  return text;
}

void add_leaf(openvdb::FloatGrid& grid, std::unique_ptr<Leaf>& leaf) {
  if (leaf && !leaf->isEmpty()) grid.tree().addLeaf(leaf.release());
}

/// A grid of the cells of `range`, active where value(index into the range) is not NaN.
template <class Value>
openvdb::FloatGrid::Ptr dense_grid(const FieldRequest& request, const std::string& name,
                                   const std::string& units, float background, const DenseShares& shares,
                                   const Value& value) {
  const openvdb::FloatGrid::Ptr grid = new_grid(request, name, units, background);
  grid->insertMeta("average_length", openvdb::DoubleMetadata(request.average_length));
  grid->insertMeta("average_window", openvdb::StringMetadata(std::string(name_of(request.average_window))));
  const CellRange& range = shares.range;
  if (range.empty()) return grid;
  std::array<std::int64_t, 3> first, count;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = range.lo[axis] / kBlock;
    count[axis] = (range.hi[axis] - 1) / kBlock + 1 - first[axis];
  }
  std::vector<std::unique_ptr<Leaf>> leaves(static_cast<std::size_t>(count[0] * count[1] * count[2]));
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t l) {
    const auto b = static_cast<std::int64_t>(l);
    const std::array<std::int64_t, 3> block{first[0] + b / (count[1] * count[2]),
                                            first[1] + b / count[2] % count[1], first[2] + b % count[2]};
    const CellRange cells = intersection(block_cells(request.lattice, block), range);
    leaves[l] = std::make_unique<Leaf>(
        openvdb::Coord(static_cast<int>(block[0] * kBlock), static_cast<int>(block[1] * kBlock),
                       static_cast<int>(block[2] * kBlock)),
        background, false);
    for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i)
      for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j)
        for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) {
          const double v = value(shares.index(i, j, k));
          if (std::isnan(v)) continue;
          const openvdb::Coord at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
          leaves[l]->setValueOn(at, static_cast<float>(v));
        }
  });
  for (auto& leaf : leaves) add_leaf(*grid, leaf);
  return grid;
}

/// What a quantity's average is, from averages of parts (windowed_part_of) and of shares. NaN: none.
double averaged_value(const Channels& channels, const DenseParts& averages, std::size_t output,
                      std::size_t at) {
  constexpr double kLeastSolid = 1e-9, none = std::numeric_limits<double>::quiet_NaN();
  const Output& o = channels.outputs[output];
  const double solid = averages.shares.solid[at], part = averages.parts[output][at];
  if (!o.quantity.per_solid) return solid != 0 ? part : none;
  if (!(solid > kLeastSolid)) return none;
  if (o.reading == Reading::mean_velocity)
    return channels.reference[o.channel - channels.first_velocity()] + part / solid;
  if (o.reading != Reading::second_moment) return part / solid;
  double squared = 0;  // of the window's own mean; the velocity's components stand before the temperature
  for (std::size_t axis = 1; axis <= 3; ++axis) {
    const double u = averages.parts[output - axis][at] / solid;
    squared += u * u;
  }
  return std::max(0.0, part / solid - squared / 3);
}

}  // namespace

openvdb::FloatGrid::Ptr new_grid(const FieldRequest& request, const std::string& name,
                                 const std::string& units, float background) {
  const Lattice& lattice = request.lattice;
  const double h = lattice.h.x;
  const auto grid = std::make_shared<MetreGrid>(background);
  grid->setTransform(cell_transform(lattice));
  grid->setName(name);
  if (units == "1") grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->insertMeta("units", openvdb::StringMetadata(units));
  grid->insertMeta("box", openvdb::StringMetadata(box_text(lattice.box())));
  grid->insertMeta("voxel", openvdb::DoubleMetadata(h));
  grid->insertMeta("method", openvdb::StringMetadata(method_name(request)));
  grid->insertMeta("version", openvdb::StringMetadata(INTERSTICE_VERSION));
  return grid;
}

void fill_grids(const FieldRequest& request, bool walls, const Channels& channels,
                std::vector<BlockResult>& blocks, Field& field) {
  field.solid_fraction = new_grid(request, "solid_fraction", "1", 0.0f);
  field.void_fraction = new_grid(request, "void_fraction", "1", 1.0f);
  if (walls) field.available_fraction = new_grid(request, "available_fraction", "1", 1.0f);
  std::vector<openvdb::FloatGrid::Ptr> quantities;
  for (const Output& output : channels.outputs)
    quantities.push_back(new_grid(request, output.quantity.full_name(), output.quantity.units, 0.0f));
  bool tiles = false;
  for (BlockResult& block : blocks) {
    const openvdb::Coord at(static_cast<int>(block.block[0] * kBlock),
                            static_cast<int>(block.block[1] * kBlock),
                            static_cast<int>(block.block[2] * kBlock));
    tiles = tiles || block.solid_tile;
    if (block.solid_tile) {
      field.solid_fraction->tree().addTile(1, at, block.tile_share, true);
      field.void_fraction->tree().addTile(1, at, 1 - block.tile_share, true);
      continue;
    }
    if (block.wall_tile) {
      field.void_fraction->tree().addTile(1, at, 0.0f, true);
      field.available_fraction->tree().addTile(1, at, 0.0f, true);
      continue;
    }
    add_leaf(*field.solid_fraction, block.solid_leaf);
    add_leaf(*field.void_fraction, block.void_leaf);
    if (walls) add_leaf(*field.available_fraction, block.available_leaf);
    for (std::size_t q = 0; q < quantities.size(); ++q) add_leaf(*quantities[q], block.quantity_leaves[q]);
  }
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const Output& output = channels.outputs[q];
    if (output.is_mass()) {
      field.mass_density = quantities[q];
      continue;
    }
    field.quantities.push_back(output.quantity);
    field.quantities.back().grid = quantities[q];
  }
  if (!tiles) return;
  openvdb::tools::prune(field.solid_fraction->tree());  // the inside of a large sphere: few tiles, large ones
  openvdb::tools::prune(field.void_fraction->tree());
}

void fill_averaged_grids(const FieldRequest& request, const Channels& channels, const DenseParts& averages,
                         Field& field) {
  const DenseShares& shares = averages.shares;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto solid = [&](std::size_t at) { return shares.solid[at]; };
  field.solid_fraction_averaged =
      dense_grid(request, "solid_fraction_averaged", "1", 0.0f, shares,
                 [&](std::size_t at) { return solid(at) != 0 ? solid(at) : none; });
  field.void_fraction_averaged =
      dense_grid(request, "void_fraction_averaged", "1", 1.0f, shares,
                 [&](std::size_t at) { return solid(at) != 0 ? 1 - solid(at) : none; });
  auto quantity = field.quantities.begin();
  for (std::size_t o = 0; o < channels.outputs.size(); ++o) {
    if (channels.outputs[o].is_mass()) continue;
    QuantityGrid& q = *quantity++;
    if (!channels.outputs[o].averageable()) continue;
    q.averaged = dense_grid(request, q.full_name() + "_averaged", q.units, 0.0f, shares,
                            [&](std::size_t at) { return averaged_value(channels, averages, o, at); });
  }
}

}  // namespace interstice::voxel
