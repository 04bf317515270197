#include "dem/grain_store.h"

namespace interstice::dem {
namespace {

template <class Real>
PairRow<Real> pair_row(const GrainRow& g) {
  const auto r = [](double value) { return static_cast<Real>(value); };
  return {g.x,     g.y,       g.z,     g.radius, r(g.vx), r(g.vy),
          r(g.vz), r(g.mass), r(g.wx), r(g.wy),  r(g.wz), g.material};
}

template <class Vector>
void take_from(Vector& v, std::span<const std::uint32_t> order) {
  if (v.empty()) return;
  Vector taken(order.size());
  for (std::size_t s = 0; s < order.size(); ++s) taken[s] = v[order[s]];
  v = std::move(taken);
}

}  // namespace

void GrainStore::clear() {
  singles_.clear();
  doubles_.clear();
  motions_.clear();
  labels_.clear();
  accelerations_.clear();
}

void GrainStore::add(const GrainRow& g, const GrainAcceleration& acceleration) {
  if (single_) {
    singles_.push_back(pair_row<float>(g));
  } else {
    doubles_.push_back(pair_row<double>(g));
  }
  motions_.push_back({g.velocity(), 1 / g.mass, g.spin(), 1 / (0.4 * g.mass * g.radius * g.radius)});
  labels_.push_back({g.position(), g.id, g.mass, g.layer});
  accelerations_.push_back(acceleration);
}

void GrainStore::take(std::span<const std::uint32_t> order) {
  take_from(singles_, order);
  take_from(doubles_, order);
  take_from(motions_, order);
  take_from(labels_, order);
  take_from(accelerations_, order);
}

void GrainStore::set_stepping(bool stepping) {
  stepping_ = stepping;
  if (stepping) accelerations_ = {};
}

GrainRow GrainStore::row(std::size_t s) const {
  const GrainMotion& m = motions_[s];
  const GrainLabel& label = labels_[s];
  return with_rows([&](const auto& rows) {
    const auto& r = rows[s];
    const auto d = [](auto value) { return static_cast<double>(value); };
    Vec3d v = m.velocity, w = m.spin;
    if (stepping_) v = {d(r.vx), d(r.vy), d(r.vz)}, w = {d(r.wx), d(r.wy), d(r.wz)};
    return GrainRow{
        r.x,        r.y, r.z, r.radius, v.x,      v.y,         v.z,
        label.mass, w.x, w.y, w.z,      label.id, label.layer, static_cast<std::uint16_t>(r.material)};
  });
}

GrainSite GrainStore::site(std::size_t s) const {
  return with_rows([&](const auto& rows) {
    return GrainSite{rows[s].x, rows[s].y, rows[s].z, rows[s].radius, labels_[s].id};
  });
}

std::vector<GrainSite> GrainStore::sites() const {
  std::vector<GrainSite> all(size());
  for (std::size_t s = 0; s < all.size(); ++s) all[s] = site(s);
  return all;
}

std::size_t GrainStore::bytes() const {
  const auto held = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return held(singles_) + held(doubles_) + held(motions_) + held(labels_) + held(accelerations_);
}

}  // namespace interstice::dem
