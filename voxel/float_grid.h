// OpenVDB's FloatGrid by name only: its headers take twenty seconds to compile, and most code only passes
// grids on. Include <openvdb/openvdb.h> where a grid is looked into.
#pragma once

#include <openvdb/version.h>

#include <cstdint>
#include <memory>

namespace openvdb {
OPENVDB_USE_VERSION_NAMESPACE
namespace OPENVDB_VERSION_NAME {
template <typename>
class Grid;
namespace tree {
template <typename>
class Tree;
template <typename>
class RootNode;
template <typename, std::uint32_t>
class InternalNode;
template <typename, std::uint32_t>
class LeafNode;
}  // namespace tree
}  // namespace OPENVDB_VERSION_NAME
}  // namespace openvdb

namespace interstice::voxel {

/// The same types as openvdb::FloatGrid and openvdb::FloatGrid::Ptr.
using FloatGrid = openvdb::Grid<openvdb::tree::Tree<openvdb::tree::RootNode<
    openvdb::tree::InternalNode<openvdb::tree::InternalNode<openvdb::tree::LeafNode<float, 3>, 4>, 5>>>>;
using FloatGridPtr = std::shared_ptr<FloatGrid>;

}  // namespace interstice::voxel
