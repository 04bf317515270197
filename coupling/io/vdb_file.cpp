#include "coupling/io/vdb_file.h"

#include <openvdb/openvdb.h>

#include <cmath>

#include "coupling/io/vdb_archive.h"

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
    const auto named = grid->copyGrid();  // shares the tree; the name and metadata are its own
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
  write_grids(path, grids, file_metadata(*grids.front()));
}

}  // namespace interstice::io
