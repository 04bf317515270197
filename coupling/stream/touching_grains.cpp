#include "coupling/stream/touching_grains.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "dem/neighbours.h"
#include "voxel/touch.h"

namespace interstice::stream {

void check_touching(const io::ParticleFrame& frame, const voxel::FieldRequest& request) {
  double largest = 0;
  for (const double radius : frame.radius) largest = std::max(largest, radius);
  const Vec3d size = request.lattice.box().size();
  for (int axis = 0; axis < 3; ++axis) {
    if (!request.periodic[axis] || size[axis] > 4 * largest * (1 + kTouchingGap)) continue;
    throw InputError(fmt::format(
        "coordination: the box repeats along {0} in less than two of the largest grains; contacts "
        "cannot be told apart there; leave {0} out of --periodic, or the quantity out",
        "xyz"[axis]));
  }
}

std::vector<double> touching_grains(const io::ParticleFrame& frame, const voxel::Solids& solids,
                                    const voxel::FieldRequest& request) {
  std::vector<double> touched(frame.size(), 0.0);
  std::vector<dem::GrainSite> sites(frame.size());
  double largest = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites[i].x = frame.x[i], sites[i].y = frame.y[i], sites[i].z = frame.z[i];
    sites[i].radius = frame.radius[i];
    sites[i].id = static_cast<std::int64_t>(i);
    largest = std::max(largest, frame.radius[i]);
  }
  const dem::SearchSpace space{request.lattice.box(), request.periodic, 2 * kTouchingGap * largest};
  for (const dem::PairRef& pair : dem::find_pairs(sites, space)) {
    const dem::GrainSite &a = sites[pair.a], &b = sites[pair.b];
    const double distance = norm(dem::separation(a.position(), b.position(), space));
    if (distance > (a.radius + b.radius) * (1 + kTouchingGap)) continue;
    ++touched[pair.a], ++touched[pair.b];
  }
  voxel::for_each_solid(solids, [&](const auto& solid) {
    for (std::size_t i = 0; i < sites.size(); ++i)
      touched[i] += voxel::within_reach(solid, sites[i].position(), sites[i].radius * (1 + kTouchingGap));
  });
  return touched;
}

}  // namespace interstice::stream
