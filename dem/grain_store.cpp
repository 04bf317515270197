#include "dem/grain_store.h"

namespace interstice::dem {
namespace {

template <class Real>
PairRow<Real> pair_row(const GrainRow& g) {
  const auto r = [](double value) { return static_cast<Real>(value); };
  return {g.x,     g.y,           g.z,     g.radius, r(g.vx), r(g.vy),
          r(g.vz), r(1 / g.mass), r(g.wx), r(g.wy),  r(g.wz), r(g.radius)};
}

template <class Vector>
void take_from(Vector& v, std::span<const std::uint32_t> order, std::size_t size) {
  if (v.empty()) return;
  Vector taken(size);
  for (std::size_t s = 0; s < order.size(); ++s) taken[s] = v[order[s]];
  v = std::move(taken);
}

/// Puts a row after `count` others, in whole groups.
template <class Rows>
void put_row(Rows& rows, std::size_t count, const GrainRow& g) {
  using Real = decltype(rows[0].vx);
  if (count % kLanes == 0) rows.resize(count + kLanes);
  rows[count] = pair_row<Real>(g);
}

}  // namespace

void GrainStore::clear() {
  singles_.clear();
  doubles_.clear();
  motions_.clear();
  labels_.clear();
  materials_.clear();
  accelerations_.clear();
  slow_accelerations_.clear();
  rests_.clear();
}

void GrainStore::add(const GrainRow& g, const GrainAcceleration& acceleration,
                     const GrainAcceleration& slow_acceleration) {
  const std::size_t slot = size();
  if (single_) {
    put_row(singles_, slot, g);
  } else {
    put_row(doubles_, slot, g);
  }
  if (slot % kLanes == 0) motions_.push_back({});
  motions_.back().set(slot % kLanes,
                      {g.velocity(), 1 / g.mass, g.spin(), 1 / (0.4 * g.mass * g.radius * g.radius)});
  labels_.push_back({g.position(), g.mass, static_cast<std::uint32_t>(g.id), g.layer});
  materials_.push_back(g.material);
  accelerations_.push_back(acceleration);
  if (two_rates_) slow_accelerations_.push_back(slow_acceleration);
  if (keeps_rests_) rests_.emplace_back();
}

void GrainStore::take(std::span<const std::uint32_t> order) {
  const std::size_t groups = groups_for(order.size());
  take_from(singles_, order, groups * kLanes);
  take_from(doubles_, order, groups * kLanes);
  LargeVector<GroupMotion> motions(groups);
  for (std::size_t s = 0; s < order.size(); ++s)
    motions[s / kLanes].set(s % kLanes, motions_[order[s] / kLanes].at(order[s] % kLanes));
  motions_ = std::move(motions);
  take_from(labels_, order, order.size());
  take_from(materials_, order, order.size());
  take_from(accelerations_, order, order.size());
  take_from(slow_accelerations_, order, order.size());
  take_from(rests_, order, order.size());
}

void GrainStore::halt(std::size_t s) {
  const GrainMotion m = motions_[s / kLanes].at(s % kLanes);
  motions_[s / kLanes].set(s % kLanes, {{0, 0, 0}, m.inverse_mass, {0, 0, 0}, m.inverse_inertia});
  with_rows([&](auto& rows) {
    rows[s].vx = rows[s].vy = rows[s].vz = 0;
    rows[s].wx = rows[s].wy = rows[s].wz = 0;
  });
}

void GrainStore::set_stepping(bool stepping) {
  stepping_ = stepping;
  if (!stepping) return;
  for (auto* kept : {&accelerations_, &slow_accelerations_}) {
    kept->clear();
    if (kept->capacity() > size() + size() / 16) kept->shrink_to_fit();  // grains came one by one
  }
}

void GrainStore::keep_accelerations() {
  accelerations_.resize(size());
  if (two_rates_) slow_accelerations_.resize(size());
}

GrainRow GrainStore::row(std::size_t s) const {
  const GrainMotion m = motions_[s / kLanes].at(s % kLanes);
  const GrainLabel& label = labels_[s];
  return with_rows([&](const auto& rows) {
    const auto& r = rows[s];
    const auto d = [](auto value) { return static_cast<double>(value); };
    Vec3d v = m.velocity, w = m.spin;
    if (stepping_) v = {d(r.vx), d(r.vy), d(r.vz)}, w = {d(r.wx), d(r.wy), d(r.wz)};
    return GrainRow{r.x, r.y, r.z, r.exact_radius, v.x,         v.y,          v.z, label.mass,
                    w.x, w.y, w.z, label.id,       label.layer, materials_[s]};
  });
}

GrainSite GrainStore::site(std::size_t s) const {
  return with_rows([&](const auto& rows) {
    return GrainSite{rows[s].x, rows[s].y, rows[s].z, rows[s].exact_radius, labels_[s].id};
  });
}

std::vector<GrainSite> GrainStore::sites() const {
  std::vector<GrainSite> all(size());
  for (std::size_t s = 0; s < all.size(); ++s) all[s] = site(s);
  return all;
}

std::size_t GrainStore::bytes() const {
  const auto held = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return held(singles_) + held(doubles_) + held(motions_) + held(labels_) + held(materials_) +
         held(accelerations_) + held(slow_accelerations_) + held(rests_);
}

}  // namespace interstice::dem
