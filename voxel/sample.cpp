#include "voxel/sample.h"

#include <openvdb/openvdb.h>

#include <limits>

namespace interstice::voxel {

namespace {

// Reads all of a field's grids voxel after voxel.
class Reader {
 public:
  Reader(const Field& field, Samples& out)
      : field_(field),
        out_(out),
        void_(field.void_fraction->getConstAccessor()),
        solid_(field.solid_fraction->getConstAccessor()),
        available_(
            (field.available_fraction ? field.available_fraction : field.solid_fraction)->getConstAccessor()),
        mass_((field.mass_density ? field.mass_density : field.solid_fraction)->getConstAccessor()),
        averaged_((field.void_fraction_averaged ? field.void_fraction_averaged : field.void_fraction)
                      ->getConstAccessor()) {
    for (const QuantityGrid& q : field.quantities) {
      out.quantities.push_back({q.full_name(), q.units, {}, {}});
      quantities_.push_back(q.grid->getConstAccessor());
      quantities_averaged_.push_back((q.averaged ? q.averaged : q.grid)->getConstAccessor());
    }
  }

  void read(const std::array<std::int64_t, 3>& cell) {
    const openvdb::Coord at(static_cast<int>(cell[0]), static_cast<int>(cell[1]), static_cast<int>(cell[2]));
    out_.center.push_back(field_.lattice.cell_center(cell[0], cell[1], cell[2]));
    out_.void_fraction.push_back(static_cast<double>(void_.getValue(at)));
    out_.solid_fraction.push_back(static_cast<double>(solid_.getValue(at)));
    if (field_.available_fraction)
      out_.available_fraction.push_back(static_cast<double>(available_.getValue(at)));
    if (field_.mass_density) out_.mass_density.push_back(static_cast<double>(mass_.getValue(at)));
    if (field_.void_fraction_averaged)
      out_.void_fraction_averaged.push_back(static_cast<double>(averaged_.getValue(at)));
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      out_.quantities[q].values.push_back(value_at(quantities_[q], at));
      if (field_.quantities[q].averaged)
        out_.quantities[q].averaged.push_back(value_at(quantities_averaged_[q], at));
    }
  }

 private:
  static double value_at(const openvdb::FloatGrid::ConstAccessor& grid, const openvdb::Coord& at) {
    float value = 0;
    return grid.probeValue(at, value) ? static_cast<double>(value) : std::numeric_limits<double>::quiet_NaN();
  }

  const Field& field_;
  Samples& out_;
  openvdb::FloatGrid::ConstAccessor void_, solid_, available_, mass_, averaged_;
  std::vector<openvdb::FloatGrid::ConstAccessor> quantities_, quantities_averaged_;
};

}  // namespace

Samples sample_slice(const Field& field, int axis, double at) {
  Samples samples;
  samples.normal_axis = axis;
  samples.axes = axis == 0 ? std::array{1, 2} : axis == 1 ? std::array{0, 2} : std::array{0, 1};
  samples.rows = field.lattice.n[samples.axes[0]];
  samples.columns = field.lattice.n[samples.axes[1]];
  std::array<std::int64_t, 3> cell{0, 0, 0};
  cell[axis] = cell_along(field.lattice, axis, at);
  Reader reader(field, samples);
  for (std::int64_t r = 0; r < samples.rows; ++r)
    for (std::int64_t c = 0; c < samples.columns; ++c) {
      cell[samples.axes[0]] = r;
      cell[samples.axes[1]] = c;
      reader.read(cell);
    }
  return samples;
}

std::vector<double> outside_walls(const Samples& samples, std::vector<double> values) {
  for (std::size_t i = 0; i < samples.available_fraction.size() && i < values.size(); ++i)
    if (samples.available_fraction[i] == 0) values[i] = std::numeric_limits<double>::quiet_NaN();
  return values;
}

std::vector<double> clear_of_walls(const Samples& samples) {
  std::vector<double> values = samples.void_fraction;
  for (std::size_t i = 0; i < samples.available_fraction.size() && i < values.size(); ++i)
    if (samples.available_fraction[i] < 1) values[i] = std::numeric_limits<double>::quiet_NaN();
  return values;
}

Samples sample_line(const Field& field, int axis, const Vec3d& at) {
  Samples samples;
  samples.axes = {axis, axis};
  samples.rows = 1;
  samples.columns = field.lattice.n[axis];
  std::array<std::int64_t, 3> cell{0, 0, 0};
  for (int a = 0; a < 3; ++a)
    if (a != axis) cell[a] = cell_along(field.lattice, a, at[a]);
  Reader reader(field, samples);
  for (cell[axis] = 0; cell[axis] < samples.columns; ++cell[axis]) reader.read(cell);
  return samples;
}

}  // namespace interstice::voxel
