#include "voxel/metre_grid.h"

#include <sstream>

namespace interstice::voxel {

openvdb::math::Transform::Ptr cell_transform(const Lattice& lattice) {
  using Map = openvdb::math::UniformScaleTranslateMap;
  const double h = lattice.h.x;
  const Vec3d first = lattice.cell_center(0, 0, 0);
  std::stringstream stream(std::ios::in | std::ios::out | std::ios::binary);
  // What Transform::write would have written: the map's name, its translation, then scale, voxel size,
  // inverse scale, its square and its half.
  openvdb::writeString(stream, Map::mapType());
  openvdb::Vec3d(first.x, first.y, first.z).write(stream);
  for (const double value : {h, h, 1 / h, 1 / h * (1 / h), 0.5 / h}) openvdb::Vec3d(value).write(stream);
  openvdb::io::setCurrentVersion(stream);
  auto transform = openvdb::math::Transform::createLinearTransform();
  transform->read(stream);
  return transform;
}

}  // namespace interstice::voxel
