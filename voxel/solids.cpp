#include "voxel/solids.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "voxel/overlap.h"

namespace interstice::voxel {

namespace {

Box clipped(const Box& a, const Box& b) {
  Box both;
  for (int axis = 0; axis < 3; ++axis) {
    both.lo[axis] = std::max(a.lo[axis], b.lo[axis]);
    both.hi[axis] = std::min(a.hi[axis], b.hi[axis]);
  }
  return both;
}

bool is_empty(const Box& box) { return !(box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.lo.z < box.hi.z); }

// The axis that the plane is normal to, or -1.
int normal_axis(const Plane& plane) {
  int axis = -1;
  for (int a = 0; a < 3; ++a)
    if (plane.normal[a] != 0) {
      if (axis >= 0) return -1;
      axis = a;
    }
  return axis;
}

// The solid side of an axis-aligned plane inside the cell.
Box solid_side(const Plane& plane, int axis, Box cell) {
  if (plane.normal[axis] > 0)
    cell.hi[axis] = std::min(cell.hi[axis], plane.point[axis]);
  else
    cell.lo[axis] = std::max(cell.lo[axis], plane.point[axis]);
  return cell;
}

// The distinct coordinates of the boxes' faces along an axis.
std::vector<double> cuts(const std::vector<Box>& boxes, int axis) {
  std::vector<double> at;
  for (const Box& box : boxes) {
    at.push_back(box.lo[axis]);
    at.push_back(box.hi[axis]);
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

// Volume of a union of boxes: cut space at all their faces, and count each piece once.
double union_volume(const std::vector<Box>& boxes) {
  if (boxes.empty()) return 0;
  if (boxes.size() == 1) return boxes[0].volume();
  const std::vector<double> x = cuts(boxes, 0), y = cuts(boxes, 1), z = cuts(boxes, 2);
  double volume = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < y.size(); ++j)
      for (std::size_t k = 0; k + 1 < z.size(); ++k) {
        const Box piece{{x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}};
        // faces are all among the cuts, so a piece is inside a box when its lower corner is
        const bool covered =
            std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) { return b.contains(piece.lo); });
        if (covered) volume += piece.volume();
      }
  return volume;
}

// Area of the part of a rectangle on which the distance, linear and given at its four corners in turn, is <=
// 0.
double area_below(const std::array<double, 4>& distance, double width, double height) {
  const std::array<double, 4> u{0, width, width, 0}, v{0, 0, height, height};
  double area = 0, first_u = 0, first_v = 0, last_u = 0, last_v = 0;
  bool any = false;
  const auto add = [&](double pu, double pv) {
    if (!any) {
      first_u = pu;
      first_v = pv;
      any = true;
    } else {
      area += (last_u - first_u) * (pv - first_v) - (pu - first_u) * (last_v - first_v);
    }
    last_u = pu;
    last_v = pv;
  };
  for (int c = 0; c < 4; ++c) {
    const int d = (c + 1) % 4;
    if (distance[c] <= 0) add(u[c], v[c]);
    if ((distance[c] < 0 && distance[d] > 0) || (distance[c] > 0 && distance[d] < 0)) {
      const double t = distance[c] / (distance[c] - distance[d]);
      add(u[c] + t * (u[d] - u[c]), v[c] + t * (v[d] - v[c]));
    }
  }
  return 0.5 * area;
}

// Volume of the cell on the solid side of any plane: a sum of pyramids over the cell's faces with their apex
// on the plane, so that the cut itself adds nothing and no small component of the normal is divided by.
double oblique_volume(const Plane& plane, const Box& cell) {
  const Vec3d size = cell.size(), center = cell.center();
  const double centre_distance = plane.distance(center);
  const double reach = 0.5 * (std::abs(plane.normal.x) * size.x + std::abs(plane.normal.y) * size.y +
                              std::abs(plane.normal.z) * size.z);
  if (centre_distance >= reach) return 0;
  if (centre_distance <= -reach) return cell.volume();
  const Vec3d apex = -centre_distance * plane.normal;  // from the centre
  double volume = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const double du = 0.5 * size[a] * plane.normal[a], dv = 0.5 * size[b] * plane.normal[b];
    for (const double side : {-1.0, 1.0}) {
      const double d = centre_distance + side * 0.5 * size[axis] * plane.normal[axis];
      const double area = area_below({d - du - dv, d + du - dv, d + du + dv, d - du + dv}, size[a], size[b]);
      volume += area * (0.5 * size[axis] - side * apex[axis]) / 3;
    }
  }
  return std::clamp(volume, 0.0, cell.volume());
}

}  // namespace

Solids translated(const Solids& solids, const Vec3d& offset) {
  Solids moved = solids;
  for (Shape& shape : moved.shapes) shape = translated(shape, offset);
  for (Ball& ball : moved.balls) ball.center += offset;
  for (Cylinder& cylinder : moved.cylinders) cylinder.from += offset, cylinder.to += offset;
  for (MeshSolid& mesh : moved.meshes) mesh.at += offset;
  return moved;
}

double solid_volume(const Solids& solids, const Box& cell) {
  std::vector<Box> boxes;
  double others = 0;
  for (const Shape& shape : solids.shapes) {
    Box part;
    if (const auto* plane = std::get_if<Plane>(&shape)) {
      const int axis = normal_axis(*plane);
      if (axis < 0) {
        others += oblique_volume(*plane, cell);
        continue;
      }
      part = solid_side(*plane, axis, cell);
    } else {
      part = clipped(std::get<Box>(shape), cell);
    }
    if (!is_empty(part)) boxes.push_back(part);
  }
  for (const Ball& ball : solids.balls) others += sphere_box_volume(ball.center, ball.radius, cell);
  for (const Cylinder& cylinder : solids.cylinders) others += cylinder_volume(cylinder, cell);
  for (const MeshSolid& mesh : solids.meshes)
    add_mesh_volumes(mesh, cell.lo, cell.size(), {1, 1, 1}, &others);
  return std::clamp(union_volume(boxes) + others, 0.0, cell.volume());
}

}  // namespace interstice::voxel
