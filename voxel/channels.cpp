#include "voxel/channels.h"

#include <algorithm>
#include <optional>

#include "voxel/sum.h"

namespace interstice::voxel {

namespace {

/// Puts channels one after the other while outputs are listed.
class Layout {
 public:
  explicit Layout(Channels& channels) : channels_(channels) {}

  /// A quantity whose channel holds a sum of shares times weights.
  void add(const char* name, const char* component, const char* units, bool per_solid) {
    output(name, component, units, per_solid, Reading::sum, ++channels_.linear);
  }
  void output(const std::string& name, const char* component, const char* units, bool per_solid,
              Reading reading, int channel, double factor = 1) {
    channels_.outputs.push_back(
        {{name, component, units, per_solid, nullptr, nullptr, 0, 0}, reading, channel, factor});
  }

 private:
  Channels& channels_;
};

constexpr const char* kTensor[] = {"xx", "yy", "zz", "xy", "yz", "xz"};
constexpr const char* kAxes[] = {"x", "y", "z"};

/// What is known of the spheres' density: nothing, one for all, or that it differs.
struct Density {
  bool known = false;
  std::optional<double> common;

  bool differs() const { return known && !common; }
};

Density density_of(const SpheresView& spheres, double given) {
  if (!spheres.density) return {given > 0, given};
  const double* const end = spheres.density + spheres.count;
  const double first = spheres.count > 0 ? *spheres.density : 0.0;
  if (std::all_of(spheres.density, end, [&](double density) { return density == first; }))
    return {true, first};
  return {true, {}};
}

void lay_out(const QuantityRequest& request, const Density& density, Channels& channels) {
  Layout layout(channels);
  if (density.differs()) layout.add("mass_density", "", "kg/m^3", false);
  if (density.known && density.common)
    layout.output("mass_density", "", "kg/m^3", false, Reading::sum, 0, *density.common);
  if (request.diameter) layout.add("mean_diameter", "", "m", true);
  if (request.coordination) layout.add("coordination", "", "1", true);
  if (request.stress) {
    const int first = channels.linear + 1;
    for (const char* component : kTensor) layout.add("stress", component, "Pa", false);
    layout.output("pressure", "", "Pa", false, Reading::pressure, first);
  }
  if (request.bonded) {
    layout.add("bonded_fraction", "", "1", true);
    layout.output("bonded_mask", "", "1", true, Reading::mask, channels.linear);
  }
  for (const std::string& group : request.groups)
    layout.output("solid_fraction_" + group, "", "1", false, Reading::sum,
                  channels.linear + 1 + channels.groups++);
  channels.velocity = request.velocity || request.temperature;
  channels.moment = request.temperature;
  for (int axis = 0; axis < 3 && channels.velocity; ++axis)
    layout.output("velocity", kAxes[axis], "m/s", true, Reading::mean_velocity,
                  channels.first_velocity() + axis);
  if (channels.moment)
    layout.output("temperature", "", "m^2/s^2", true, Reading::second_moment, channels.first_velocity() + 3);
}

void fill_weights(const SpheresView& spheres, const QuantityRequest& request, const Density& density,
                  Channels& channels) {
  if (channels.linear == 0) return;
  channels.weights.reserve(spheres.count * static_cast<std::size_t>(channels.linear));
  for (std::size_t s = 0; s < spheres.count; ++s) {  // in the order of lay_out
    const auto add = [&](double weight) { channels.weights.push_back(weight); };
    if (density.differs()) add(spheres.density[s]);
    if (request.diameter) add(2 * spheres.radius[s]);
    if (request.coordination) add(spheres.coordination[s]);
    for (std::size_t c = 0; c < 6 && request.stress; ++c) add(spheres.stress[c][s]);
    if (request.bonded) add(spheres.bonded[s] != 0 ? 1.0 : 0.0);
  }
}

Vec3d mean_velocity(const SpheresView& spheres) {
  CompensatedSum volume, moved[3];
  for (std::size_t s = 0; s < spheres.count; ++s) {
    const double r = spheres.radius[s], v = r * r * r;
    volume.add(v);
    for (std::size_t axis = 0; axis < 3; ++axis) moved[axis].add(v * spheres.velocity[axis][s]);
  }
  if (!(volume.value() > 0)) return {0, 0, 0};
  const double inverse = 1 / volume.value();
  return {inverse * moved[0].value(), inverse * moved[1].value(), inverse * moved[2].value()};
}

}  // namespace

Channels channels_for(const SpheresView& spheres, const QuantityRequest& request, double density) {
  const Density known = density_of(spheres, density);
  Channels channels;
  lay_out(request, known, channels);
  fill_weights(spheres, request, known, channels);
  channels.group = spheres.group;
  channels.v = spheres.velocity;
  if (channels.velocity) channels.reference = mean_velocity(spheres);
  return channels;
}

double windowed_part_of(const Output& output, const Channels& channels, const double* at,
                        std::int64_t plane) {
  const double solid = at[0];
  const auto relative = [&](int axis) {
    return at[(channels.first_velocity() + axis) * plane] - channels.reference[axis];
  };
  if (output.reading == Reading::mean_velocity)
    return solid * relative(output.channel - channels.first_velocity());
  if (output.reading != Reading::second_moment)
    return with_part_of(output, plane, [&](const auto& part) { return part(at); });
  const Vec3d u{relative(0), relative(1), relative(2)};
  return (at[output.channel * plane] + solid * dot(u, u)) / 3;
}

}  // namespace interstice::voxel
