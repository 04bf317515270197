#include "coupling/studies/difference_field.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <sstream>

#include "base/error.h"
#include "coupling/io/vdb_archive.h"
#include "coupling/io/vti_file.h"
#include "voxel/metre_grid.h"

namespace interstice::studies {
namespace {

using Grid = openvdb::FloatGrid;
using openvdb::Coord;
using openvdb::CoordBBox;

struct File {
  std::filesystem::path path;
  openvdb::GridPtrVecPtr grids;
  Vec3d lo;          // corner of the first cell [m]
  double voxel = 0;  // [m]
  CoordBBox cells;

  Grid::Ptr grid(const std::string& name) const {
    for (const auto& grid : *grids) {
      if (grid->getName() == name) return openvdb::gridPtrCast<Grid>(grid);
    }
    return nullptr;
  }
};

/// The number of cells comes from the box in the metadata: where the powder ends says nothing about the
/// lattice.
CoordBBox cells_of(const Grid& grid, double voxel) {
  const auto box = grid.getMetadata<openvdb::StringMetadata>("box");  // x0,x1,y0,y1,z0,z1 [m]
  if (!box) return grid.evalActiveVoxelBoundingBox();
  std::istringstream words(box->value());
  Coord last;
  for (int axis = 0; axis < 3; ++axis) {
    double lo = 0, hi = 0;
    char comma = 0;
    words >> lo >> comma >> hi >> comma;
    last[axis] = static_cast<int>(std::lround((hi - lo) / voxel)) - 1;
  }
  return {Coord(0), last};
}

File open(const std::filesystem::path& path) {
  openvdb::initialize();
  File result;
  result.path = path;
  try {
    openvdb::io::File file(path.string());
    file.open(false);  // no delayed loading: the file may be replaced while we hold its grids
    result.grids = file.getGrids();
    file.close();
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: cannot be read as OpenVDB: {}", path.string(), error.what()));
  }
  const auto grid = result.grid("void_fraction");
  if (!grid) throw InputError(fmt::format("{}: has no grid void_fraction", path.string()));
  result.voxel = grid->voxelSize().x();
  const auto first = grid->indexToWorld(openvdb::Vec3d(0.0));
  result.lo = Vec3d{first.x(), first.y(), first.z()} - 0.5 * result.voxel * Vec3d{1, 1, 1};
  result.cells = cells_of(*grid, result.voxel);
  return result;
}

/// Cell c of A is cell c + shift of B; an obstacle where the cells of the two do not coincide.
std::string match(const File& a, const File& b, Coord& shift) {
  if (std::abs(a.voxel - b.voxel) > 1e-9 * a.voxel) {
    return fmt::format("the cells differ in size ({:g} um in A, {:g} um in B)", a.voxel * 1e6, b.voxel * 1e6);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = (a.lo[axis] - b.lo[axis]) / a.voxel;
    shift[axis] = static_cast<int>(std::lround(cells));
    if (std::abs(cells - shift[axis]) > 1e-4) {
      return fmt::format("the cells are shifted by a fraction of a cell along {}", "xyz"[axis]);
    }
  }
  return "";
}

/// Calls visit(cell) for every active cell of `grid` inside `box`, cell by cell also where the tree holds a
/// tile.
template <class Visit>
void for_active_cells(const Grid& grid, const CoordBBox& box, const Visit& visit) {
  for (auto value = grid.cbeginValueOn(); value; ++value) {
    CoordBBox cells = value.getBoundingBox();
    cells.intersect(box);
    if (cells.empty()) continue;
    for (auto cell = cells.begin(); cell; ++cell) visit(*cell);
  }
}

/// B - A on `common` (cells of A), counted from its first cell.
Grid::Ptr subtract(const Grid& a, const Grid& b, const Coord& shift, const CoordBBox& common) {
  const Grid::Ptr result = std::make_shared<voxel::MetreGrid>(0.0F);
  const auto from = a.getConstAccessor(), with = b.getConstAccessor();
  auto into = result->getAccessor();
  const auto set = [&](const Coord& cell) {
    into.setValue(cell - common.min(), with.getValue(cell + shift) - from.getValue(cell));
  };
  for_active_cells(a, common, set);
  for_active_cells(b, CoordBBox(common.min() + shift, common.max() + shift),
                   [&](const Coord& c) { set(c - shift); });
  return result;
}

void add_statistics(FieldDifference& difference) {
  double sum = 0, squares = 0;
  for (auto value = difference.field.void_fraction->cbeginValueOn(); value; ++value) {
    const double d = *value;
    sum += d;
    squares += d * d;
    if (std::abs(d) > std::abs(difference.largest)) difference.largest = d;
  }
  const auto cells = static_cast<double>(difference.field.lattice.cells());
  difference.mean = sum / cells;
  difference.rms = std::sqrt(squares / cells);
}

}  // namespace

FieldDifference field_difference(const std::filesystem::path& a_path, const std::filesystem::path& b_path) {
  const File a = open(a_path), b = open(b_path);
  FieldDifference difference;
  Coord shift;
  difference.obstacle = match(a, b, shift);
  if (!difference.obstacle.empty()) return difference;
  CoordBBox common = a.cells;
  common.intersect(CoordBBox(b.cells.min() - shift, b.cells.max() - shift));
  if (common.empty()) {
    difference.obstacle = "their boxes do not overlap";
    return difference;
  }
  difference.whole = common == a.cells && shift == Coord(0) && a.cells == b.cells;

  voxel::Field& field = difference.field;
  const auto corner = [&](int axis) { return a.lo[axis] + common.min()[axis] * a.voxel; };
  field.lattice.lo = {corner(0), corner(1), corner(2)};
  field.lattice.h = {a.voxel, a.voxel, a.voxel};
  field.lattice.n = {common.dim().x(), common.dim().y(), common.dim().z()};
  const auto of = [&](const char* name) -> Grid::Ptr {
    const auto from = a.grid(name), with = b.grid(name);
    if (!from || !with) return nullptr;
    auto grid = subtract(*from, *with, shift, common);
    grid->setTransform(voxel::cell_transform(field.lattice));
    grid->setName(std::string(name) + "_difference");
    return grid;
  };
  field.void_fraction = of("void_fraction");
  field.solid_fraction = of("solid_fraction");
  field.void_fraction_averaged = of("void_fraction_averaged");
  field.solid_fraction_averaged = of("solid_fraction_averaged");
  add_statistics(difference);
  return difference;
}

void write_difference(const std::filesystem::path& path_without_extension, const FieldDifference& difference,
                      const std::string& source) {
  const voxel::Field& field = difference.field;
  openvdb::GridCPtrVec grids;
  for (const auto& grid : {field.void_fraction, field.solid_fraction, field.void_fraction_averaged,
                           field.solid_fraction_averaged}) {
    if (!grid) continue;
    grid->insertMeta("source", openvdb::StringMetadata(source));
    io::add_statistics(*grid, grids);
    grids.push_back(grid);
  }
  auto path = path_without_extension;
  path += ".vdb";
  io::write_grids(path, grids, openvdb::MetaMap());
  if (!field.solid_fraction) return;  // the .vti writer wants both
  path = path_without_extension;
  path += ".vti";
  io::write_vti(path, field, std::nan(""));
}

}  // namespace interstice::studies
