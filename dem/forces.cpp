// The loops of the CPU back end over contacts: pairs, walls, and the collection of forces by grain. The laws
// themselves are in contact/.
#include <cmath>

#include "base/parallel.h"
#include "dem/contact/contact.h"
#include "dem/simulation.h"
#include "dem/wall_distance.h"

namespace interstice::dem {
namespace {

constexpr std::size_t kPairsPerBlock = 1024;

/// Calls body.template operator()<Tangential, Rolling, Cohesion>() for the features chosen at run time.
template <class Body>
void with_features(const Features& f, const Body& body) {
  const auto cohesion = [&]<bool T, bool R>() {
    f.cohesion ? body.template operator()<T, R, true>() : body.template operator()<T, R, false>();
  };
  const auto rolling = [&]<bool T>() {
    f.rolling ? cohesion.template operator()<T, true>() : cohesion.template operator()<T, false>();
  };
  f.tangential ? rolling.template operator()<true>() : rolling.template operator()<false>();
}

}  // namespace

template <bool T, bool R, bool C>
void Simulation::evaluate_pairs_with() {
  using Chosen = ContactFeatures<T, R, C>;
  const SearchSpace space = search_space();
  const bool wraps = space.periodic[0] || space.periodic[1] || space.periodic[2];
  const std::size_t materials = model_.materials.size();
  const bool clip = model_.features.clip_tension;
  const double dt = dt_;
  PairContacts& list = pair_contacts_;
  const auto body = [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const GrainRow& a = rows_[list.pairs[k].a];
      const GrainRow& b = rows_[list.pairs[k].b];
      const Vec3d apart = wraps ? separation(a.position(), b.position(), space) : a.position() - b.position();
      const double reach = a.radius + b.radius, d2 = dot(apart, apart);
      if (d2 >= reach * reach) {
        if (list.touching[k]) {
          list.touching[k] = 0;
          list.spring[k] = {};
        }
        continue;
      }
      ContactKinematics<double> kin;
      const double d = d2 > 0 ? std::sqrt(d2) : 1e-6 * reach;
      kin.normal = d2 > 0 ? (1 / d) * apart : Vec3d{1, 0, 0};  // coincident centres: a fixed direction
      kin.overlap = reach - d;
      kin.effective_radius = a.radius * b.radius / reach;
      kin.effective_mass = a.mass * b.mass / (a.mass + b.mass);
      if constexpr (C) kin.area = sphere_sphere_area(a.radius, b.radius, d, kin.overlap);
      const double arm_a = a.radius - 0.5 * kin.overlap, arm_b = b.radius - 0.5 * kin.overlap;
      kin.velocity = a.velocity() - b.velocity();
      if constexpr (T) kin.velocity -= cross(arm_a * a.spin() + arm_b * b.spin(), kin.normal);
      if constexpr (R) kin.relative_spin = a.spin() - b.spin();

      const PairConstants& c = constants_[a.material * materials + b.material];
      const ContactForce<double> f = evaluate_contact<Chosen>(kin, c, list.spring[k], dt, clip);
      list.touching[k] = 1;
      PairResult& result = list.results[k];
      result.force = f.force;
      if constexpr (T || R) {
        const Vec3d turning = cross(kin.normal, f.tangential);
        result.torque_a = f.rolling_torque - arm_a * turning;
        result.torque_b = -f.rolling_torque - arm_b * turning;
      }
      if constexpr (T) list.spring[k] = f.displacement;
    }
  };
  const Blocks blocks{list.pairs.size(), kPairsPerBlock};
  if (options_.reference) {
    body(0, 0, list.pairs.size());
  } else {
    for_each_block(blocks, body);
  }
}

void Simulation::evaluate_pairs() {
  with_features(model_.features, [&]<bool T, bool R, bool C>() { evaluate_pairs_with<T, R, C>(); });
}

template <bool T, bool R, bool C>
void Simulation::evaluate_walls_with(std::size_t slot, Vec3d& force, Vec3d& torque) {
  using Chosen = ContactFeatures<T, R, C>;
  const GrainRow& g = rows_[slot];
  for (WallContact& contact : wall_contacts_.of(slot)) {
    const WallDistance surface = wall_distance(walls_[contact.wall], g.position());
    if (surface.distance >= g.radius) {
      contact.touching = 0;
      contact.spring = {};
      continue;
    }
    ContactKinematics<double> kin;
    kin.normal = surface.normal;
    kin.overlap = g.radius - surface.distance;
    kin.effective_radius = g.radius;  // a wall is flat and heavy
    kin.effective_mass = g.mass;
    if constexpr (C) kin.area = sphere_plane_area(g.radius, kin.overlap);
    kin.velocity = g.velocity() - motion_of_wall_[contact.wall].velocity;
    if constexpr (T) kin.velocity -= cross(surface.distance * g.spin(), kin.normal);
    if constexpr (R) kin.relative_spin = g.spin();
    const PairConstants& c =
        constants_[g.material * model_.materials.size() + model_.walls[contact.wall].material];
    const ContactForce<double> f =
        evaluate_contact<Chosen>(kin, c, contact.spring, dt_, model_.features.clip_tension);
    contact.touching = 1;
    contact.force = f.force;
    if constexpr (T) contact.spring = f.displacement;
    force += f.force;
    if constexpr (T || R) torque += f.rolling_torque - surface.distance * cross(kin.normal, f.tangential);
  }
}

void Simulation::add_wall_forces(std::size_t slot, Vec3d& force, Vec3d& torque) {
  with_features(model_.features,
                [&]<bool T, bool R, bool C>() { evaluate_walls_with<T, R, C>(slot, force, torque); });
}

void Simulation::finish_rows(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    Vec3d force{0, 0, 0}, torque{0, 0, 0};
    for (const Adjacent& partner : pair_contacts_.of(i)) {
      if (!pair_contacts_.touching[partner.pair]) continue;
      const PairResult& result = pair_contacts_.results[partner.pair];
      if (partner.second) {
        force -= result.force;
        torque += result.torque_b;
      } else {
        force += result.force;
        torque += result.torque_a;
      }
    }
    if (!wall_contacts_.of(i).empty()) add_wall_forces(i, force, torque);
    GrainRow& g = rows_[i];
    GrainMotion& m = motions_[i];
    const Vec3d acceleration = model_.gravity + m.inverse_mass * force;
    const Vec3d angular = m.inverse_inertia * torque;
    const Vec3d dv = (0.5 * dt_) * (acceleration - m.acceleration), dw = (0.5 * dt_) * (angular - m.angular);
    g.vx += dv.x, g.vy += dv.y, g.vz += dv.z;
    g.wx += dw.x, g.wy += dw.y, g.wz += dw.z;
    m.acceleration = acceleration;
    m.angular = angular;
  }
}

}  // namespace interstice::dem
