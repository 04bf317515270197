#include "coupling/io/vdb_file.h"

#include <openvdb/openvdb.h>

#include <cmath>

#include "coupling/io/vdb_archive.h"
#include "voxel/metre_grid.h"

namespace interstice::io {
namespace {

// What grids do not know by themselves. Box, voxel, method and units they bring along.
void add_origin(openvdb::MetaMap& meta, const FieldFilesRequest& request) {
  meta.insertMeta("source", openvdb::StringMetadata(request.source));
  meta.insertMeta("version", openvdb::StringMetadata(request.version));
  if (request.computed.average_length > 0) {
    meta.insertMeta("average", openvdb::DoubleMetadata(request.computed.average_length));
    meta.insertMeta("average_window",
                    openvdb::StringMetadata(std::string(name_of(request.computed.average_window))));
  }
  if (std::isfinite(request.time)) meta.insertMeta("time", openvdb::DoubleMetadata(request.time));
}

// Those of the file as a whole: a copy of what all grids share.
openvdb::MetaMap file_metadata(const openvdb::GridBase& grid) {
  openvdb::MetaMap meta;
  for (const char* name :
       {"box", "voxel", "method", "source", "version", "average", "average_window", "time"}) {
    if (const auto value = grid[name]) meta.insertMeta(name, *value);
  }
  meta.insertMeta("units",
                  openvdb::StringMetadata("m, s; fractions per cell volume; all else as each grid says"));
  return meta;
}

// The three components that begin at `first`, as one grid of vectors.
openvdb::GridBase::Ptr vector_grid(const voxel::FloatGridPtr (&components)[3], const std::string& name) {
  const auto& first = *components[0];
  const auto tree =
      std::make_shared<openvdb::Vec3STree>(first.tree(), openvdb::Vec3f(0), openvdb::TopologyCopy());
  const auto y = components[1]->getConstAccessor(), z = components[2]->getConstAccessor();
  for (auto leaf = tree->beginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->beginValueOn(); value; ++value) {
      const openvdb::Coord at = value.getCoord();
      value.setValue({first.tree().getValue(at), y.getValue(at), z.getValue(at)});
    }
  }
  const auto grid = std::make_shared<voxel::MetreGridOf<openvdb::Vec3SGrid>>(tree);
  grid->insertMeta(first);
  grid->setTransform(openvdb::ConstPtrCast<openvdb::math::Transform>(first.constTransformPtr()));
  grid->setName(name);
  grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
  return grid;
}

}  // namespace

void write_vdb(const std::filesystem::path& path, const voxel::Field& field,
               const FieldFilesRequest& request) {
  openvdb::initialize();
  openvdb::GridCPtrVec grids;
  const auto keep = [&](const openvdb::GridBase::Ptr& grid) {
    add_origin(*grid, request);
    add_statistics(*grid, grids);
    grids.push_back(grid);
  };
  const auto add = [&](const openvdb::FloatGrid::Ptr& grid, const std::string& name) {
    if (!grid) return;
    const auto named = grid->copyGrid();  // shares the tree; the name and metadata are its own
    named->setName(name);
    keep(named);
  };
  add(field.void_fraction, "void_fraction");
  add(field.solid_fraction, "solid_fraction");
  add(field.available_fraction, "available_fraction");
  add(field.mass_density, "mass_density");
  add(field.void_fraction_averaged, "void_fraction_averaged");
  add(field.solid_fraction_averaged, "solid_fraction_averaged");
  for (std::size_t q = 0; q < field.quantities.size(); ++q) {
    const voxel::QuantityGrid* const all = field.quantities.data() + q;
    if (all->name != "velocity") {
      add(all->grid, all->full_name());
      add(all->averaged, all->full_name() + "_averaged");
      continue;
    }
    keep(vector_grid({all[0].grid, all[1].grid, all[2].grid}, "velocity"));
    if (all->averaged)
      keep(vector_grid({all[0].averaged, all[1].averaged, all[2].averaged}, "velocity_averaged"));
    q += 2;
  }
  write_grids(path, grids, file_metadata(*grids.front()));
}

}  // namespace interstice::io
