#include "coupling/io/vdb_file.h"

#include <openvdb/openvdb.h>

#include <cmath>
#include <memory>

#include "coupling/io/atomic_file.h"

namespace interstice::io {
namespace {

// A grid as io::File can write it: it copies each grid for the sake of its metadata, and OpenVDB 10 refuses
// to copy the transform of a voxel below 14.4 um (its cube counts as zero). Here the copy shares the
// transform.
class WritableGrid : public openvdb::FloatGrid {
 public:
  explicit WritableGrid(const openvdb::FloatGrid::Ptr& grid) : openvdb::FloatGrid(grid->treePtr()) {
    setTransform(grid->transformPtr());
    for (auto it = grid->beginMeta(); it != grid->endMeta(); ++it) insertMeta(it->first, *it->second);
  }
  openvdb::GridBase::Ptr copyGrid() override {
    return openvdb::ConstPtrCast<openvdb::FloatGrid>(copyReplacingMetadata(*this));
  }
  openvdb::GridBase::ConstPtr copyGrid() const override { return copyReplacingMetadata(*this); }
};

// What grids do not know by themselves. Box, voxel, method and units they bring along.
void add_origin(openvdb::MetaMap& meta, const FieldFilesRequest& request) {
  meta.insertMeta("source", openvdb::StringMetadata(request.source));
  meta.insertMeta("version", openvdb::StringMetadata(request.version));
  if (request.computed.average_length > 0) {
    meta.insertMeta("average", openvdb::DoubleMetadata(request.computed.average_length));
  }
  if (std::isfinite(request.time)) meta.insertMeta("time", openvdb::DoubleMetadata(request.time));
}

// Those of the file as a whole: a copy of what all grids share.
openvdb::MetaMap file_metadata(const openvdb::GridBase& grid) {
  openvdb::MetaMap meta;
  for (const char* name : {"box", "voxel", "method", "source", "version", "average", "time"}) {
    if (const auto value = grid[name]) meta.insertMeta(name, *value);
  }
  meta.insertMeta("units", openvdb::StringMetadata("m, s; fractions per cell volume; densities in kg/m^3"));
  return meta;
}

}  // namespace

void write_vdb(const std::filesystem::path& path, const voxel::Field& field,
               const FieldFilesRequest& request) {
  openvdb::initialize();
  openvdb::GridCPtrVec grids;
  const auto add = [&](const openvdb::FloatGrid::Ptr& grid, const char* name) {
    if (!grid) return;
    const auto named = std::make_shared<WritableGrid>(grid);
    named->setName(name);
    add_origin(*named, request);
    grids.push_back(named);
  };
  add(field.void_fraction, "void_fraction");
  add(field.solid_fraction, "solid_fraction");
  add(field.available_fraction, "available_fraction");
  add(field.mass_density, "mass_density");
  add(field.void_fraction_averaged, "void_fraction_averaged");
  add(field.solid_fraction_averaged, "solid_fraction_averaged");
  const openvdb::MetaMap meta = file_metadata(*grids.front());
  write_atomically(path, [&](const std::filesystem::path& aside) {
    openvdb::io::File file(aside.string());
    file.write(grids, meta);
    file.close();
  });
}

}  // namespace interstice::io
