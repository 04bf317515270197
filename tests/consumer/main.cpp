// One grain falls onto a floor; its volume is found in the field. Exit status 0 when both are as they must
// be.
#include <cmath>
#include <cstdio>
#include <vector>

#include "coupling/scene/units.h"
#include "dem/simulation.h"
#include "voxel/field.h"

int main() {
  using namespace interstice;
  dem::Model model;
  model.domain = {{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}};
  model.materials = {{8200, 1e7, 0.3}};
  model.pairs = {{0.35, 0.3, 0.005, 0}};
  model.laws = {.tangential = interstice::dem::TangentialLaw::mindlin,
                .rolling = interstice::dem::RollingLaw::cdt};
  model.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  dem::Simulation simulation(model, 1e-7);
  simulation.add_grains(std::vector<dem::NewGrain>{{{0, 0, 30e-6}, 20e-6, {}, {}, 0, 0}});
  simulation.advance(100000);
  dem::GrainColumns grains;
  simulation.copy_columns(grains);

  voxel::FieldRequest request;
  request.lattice = voxel::cubic_lattice({{-1e-4, -1e-4, 0}, {1e-4, 1e-4, 1e-4}},
                                         scene::parse_quantity("10 um", scene::Dimension::length, "voxel"));
  const voxel::Field field = voxel::compute_field(
      {1, grains.x.data(), grains.y.data(), grains.z.data(), grains.radius.data(), nullptr}, {}, request);
  const double volume = 4.0 / 3 * M_PI * std::pow(20e-6, 3);
  const bool landed = std::fabs(grains.z[0] - 20e-6) < 1e-7;
  const bool counted =
      std::fabs(field.sums.solid_volume_field / volume - 1) < 1e-2;  // a little of it is in the floor
  std::printf("z = %g m, solid volume = %g of %g m^3\n", grains.z[0], field.sums.solid_volume_field, volume);
  return landed && counted ? 0 : 1;
}
