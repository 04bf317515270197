#include "voxel/grids.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>

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

void fill_grids(const FieldRequest& request, bool walls, bool mass, std::vector<BlockResult>& blocks,
                Field& field) {
  field.solid_fraction = new_grid(request, "solid_fraction", "1", 0.0f);
  field.void_fraction = new_grid(request, "void_fraction", "1", 1.0f);
  if (walls) field.available_fraction = new_grid(request, "available_fraction", "1", 1.0f);
  if (mass) field.mass_density = new_grid(request, "mass_density", "kg/m^3", 0.0f);
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
    if (mass) add_leaf(*field.mass_density, block.mass_leaf);
  }
  if (!tiles) return;
  openvdb::tools::prune(field.solid_fraction->tree());  // the inside of a large sphere: few tiles, large ones
  openvdb::tools::prune(field.void_fraction->tree());
}

void fill_averaged_grids(const FieldRequest& request, const DenseShares& averages, Field& field) {
  field.solid_fraction_averaged = new_grid(request, "solid_fraction_averaged", "1", 0.0f);
  field.void_fraction_averaged = new_grid(request, "void_fraction_averaged", "1", 1.0f);
  const openvdb::DoubleMetadata length(request.average_length);
  field.solid_fraction_averaged->insertMeta("average_length", length);
  field.void_fraction_averaged->insertMeta("average_length", length);
  if (averages.range.empty()) return;

  std::array<std::int64_t, 3> first, count;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = averages.range.lo[axis] / kBlock;
    count[axis] = (averages.range.hi[axis] - 1) / kBlock + 1 - first[axis];
  }
  struct Pair {
    std::unique_ptr<Leaf> solid, empty;
  };
  std::vector<Pair> leaves(static_cast<std::size_t>(count[0] * count[1] * count[2]));
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t l) {
    const auto b = static_cast<std::int64_t>(l);
    const std::array<std::int64_t, 3> block{first[0] + b / (count[1] * count[2]),
                                            first[1] + b / count[2] % count[1], first[2] + b % count[2]};
    const CellRange cells = intersection(block_cells(request.lattice, block), averages.range);
    const openvdb::Coord origin(static_cast<int>(block[0] * kBlock), static_cast<int>(block[1] * kBlock),
                                static_cast<int>(block[2] * kBlock));
    leaves[l].solid = std::make_unique<Leaf>(origin, 0.0f, false);
    leaves[l].empty = std::make_unique<Leaf>(origin, 1.0f, false);
    for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i)
      for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j)
        for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) {
          const double solid = averages.solid[averages.index(i, j, k)];
          if (solid == 0) continue;
          const openvdb::Coord at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
          leaves[l].solid->setValueOn(at, static_cast<float>(solid));
          leaves[l].empty->setValueOn(at, static_cast<float>(1 - solid));
        }
  });
  for (Pair& pair : leaves) {
    add_leaf(*field.solid_fraction_averaged, pair.solid);
    add_leaf(*field.void_fraction_averaged, pair.empty);
  }
}

}  // namespace interstice::voxel
