// OpenVDB grids with voxels of a few micrometres, in metres.
//
// OpenVDB (10.0) refuses to construct a scaling whose cube is below 3e-15, so in metres any voxel under 14.4
// um, although its maps, trees and files are right there all the same. Two things get around that without
// leaving metres: a transform can be read from a stream, which does not check; and a grid that is written to
// a file is copied first through a virtual function, which here shares the transform instead of constructing
// it anew.
//
// What remains: other programs can read such a file and map its coordinates, but OpenVDB functions that
// construct a new transform from it (deepCopy, copy, getAffineMap) throw ArithmeticError below 14.4 um.
#pragma once

#include <openvdb/openvdb.h>

#include <memory>

#include "voxel/lattice.h"

namespace interstice::voxel {

/// A grid that can be written to files whatever its voxels' size.
template <class Grid>
class MetreGridOf final : public Grid {
 public:
  using Tree = typename Grid::TreeType;
  using Grid::Grid;

  openvdb::GridBase::Ptr copyGrid() override { return sharing(this->treePtr()); }
  openvdb::GridBase::ConstPtr copyGrid() const override {
    return sharing(openvdb::ConstPtrCast<Tree>(this->constTreePtr()));
  }
  openvdb::GridBase::Ptr deepCopyGrid() const override {
    return sharing(std::make_shared<Tree>(this->constTree()));
  }

 private:
  openvdb::GridBase::Ptr sharing(const typename Tree::Ptr& tree) const {
    auto grid = std::make_shared<MetreGridOf>(tree);
    grid->insertMeta(*this);
    grid->setTransform(openvdb::ConstPtrCast<openvdb::math::Transform>(this->constTransformPtr()));
    return grid;
  }
};
using MetreGrid = MetreGridOf<openvdb::FloatGrid>;

/// Integer indices at the centres of a cubic lattice's cells, in metres.
openvdb::math::Transform::Ptr cell_transform(const Lattice& lattice);

}  // namespace interstice::voxel
