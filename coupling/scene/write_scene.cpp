#include "coupling/scene/write_scene.h"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <vector>

#include "coupling/scene/format_quantity.h"
#include "coupling/scene/schema.h"

namespace interstice::scene {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

/// A number: plain if it has no dimension, else in quotes with its unit.
std::string number(double value, Dimension dimension) {
  const std::string text = format_exact(value, dimension);
  if (!info(dimension).si_unit.empty()) return quoted(text);
  // "-0" would read as an integer, which has no negative zero
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}
std::string vector(const Vec3d& v, Dimension dimension) {
  return fmt::format("[{}, {}, {}]", number(v.x, dimension), number(v.y, dimension), number(v.z, dimension));
}
std::string box(const Box& b) {
  const auto ends = [&](int axis) {
    return fmt::format("[{}, {}]", number(b.lo[axis], Dimension::length),
                       number(b.hi[axis], Dimension::length));
  };
  return fmt::format("[{}, {}, {}]", ends(0), ends(1), ends(2));
}

class Writer {
 public:
  void blank() { text_ += '\n'; }
  void header(std::string_view name) { text_ += fmt::format("\n[{}]\n", name); }
  void element(std::string_view name) { text_ += fmt::format("\n[[{}]]\n", name); }
  void raw(std::string_view key, std::string_view value) {
    text_.append(key).append(" = ").append(value).append("\n");  // a list may have a hundred megabytes
  }
  void text(std::string_view key, std::string_view value) { raw(key, quoted(value)); }
  void flag(std::string_view key, bool value) { raw(key, value ? "true" : "false"); }
  void quantity(std::string_view key, double value, Dimension dimension) {
    raw(key, number(value, dimension));
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string_view word(Boundary boundary) {
  return boundary == Boundary::wall ? "wall" : boundary == Boundary::periodic ? "periodic" : "open";
}

void write_domain(Writer& out, const Domain& domain) {
  out.header("domain");
  out.raw("box", box(domain.box));
  const auto& b = domain.boundary;
  out.raw("boundary", fmt::format("[\"{}\", \"{}\", \"{}\"]", word(b[0]), word(b[1]), word(b[2])));
  const auto& m = domain.wall_material;
  if (!m[0].empty() || !m[1].empty() || !m[2].empty())
    out.raw("wall_material", fmt::format("[{}, {}, {}]", quoted(m[0]), quoted(m[1]), quoted(m[2])));
  out.raw("gravity", vector(domain.gravity, Dimension::acceleration));
}

/// What [contact] says for an enumerator: the words of its key stand in the order of the enum.
template <class Law>
void write_law(Writer& out, std::string_view key, Law law) {
  out.text(key, split_words(section("contact").find(key)->words).at(static_cast<std::size_t>(law)));
}

void write_pair(Writer& out, const Contact& contact, const ContactPair& pair) {
  constexpr Dimension plain = Dimension::dimensionless;
  out.element("contact.pair");
  out.raw("materials", fmt::format("[{}, {}]", quoted(pair.materials[0]), quoted(pair.materials[1])));
  out.quantity("restitution", pair.restitution, plain);
  if (contact.normal == NormalLaw::hooke && contact.stiffness_rule == StiffnessRule::given)
    out.quantity("stiffness", pair.stiffness, Dimension::stiffness);
  if (contact.tangential != TangentialLaw::none) out.quantity("friction", pair.friction, plain);
  if (contact.rolling != RollingLaw::none) out.quantity("rolling_friction", pair.rolling_friction, plain);
  if (contact.cohesion == CohesionLaw::sjkr)
    out.quantity("cohesion_energy_density", pair.cohesion_energy_density, Dimension::energy_density);
  if (contact.cohesion == CohesionLaw::jkr || contact.cohesion == CohesionLaw::dmt)
    out.quantity("work_of_adhesion", pair.work_of_adhesion, Dimension::surface_energy);
  if (contact.cohesion == CohesionLaw::van_der_waals) {
    out.quantity("hamaker_constant", pair.hamaker_constant, Dimension::energy);
    out.quantity("cutoff", pair.cutoff, Dimension::length);
    out.quantity("range", pair.range, Dimension::length);
  }
}

void write_contact(Writer& out, const Contact& contact) {
  out.header("contact");
  write_law(out, "normal", contact.normal);
  if (contact.normal == NormalLaw::hooke) {
    write_law(out, "stiffness_rule", contact.stiffness_rule);
    if (contact.stiffness_rule != StiffnessRule::given)
      out.quantity("design_speed", contact.design_speed, Dimension::velocity);
    if (contact.stiffness_rule == StiffnessRule::overlap)
      out.quantity("overlap_limit", contact.overlap_limit, Dimension::dimensionless);
  }
  write_law(out, "damping", contact.damping);
  write_law(out, "tangential", contact.tangential);
  if (contact.tangential == TangentialLaw::slider)
    out.quantity("slider_velocity", contact.slider_velocity, Dimension::velocity);
  write_law(out, "rolling", contact.rolling);
  write_law(out, "cohesion", contact.cohesion);
  for (const ContactPair& pair : contact.pairs) write_pair(out, contact, pair);
}

void write_diameters(Writer& out, const Diameters& d) {
  constexpr Dimension length = Dimension::length, plain = Dimension::dimensionless;
  if (d.law == SizeLaw::single) return out.quantity("diameter", d.mean, length);
  out.header("particles.diameter");
  switch (d.law) {
    case SizeLaw::normal:
      out.text("distribution", "normal");
      break;
    case SizeLaw::lognormal:
      out.text("distribution", "lognormal");
      out.quantity("median", d.mean, length);
      out.quantity("sigma", d.sd, plain);
      break;
    case SizeLaw::uniform:
      out.text("distribution", "uniform");
      break;
    case SizeLaw::bimodal:
      out.text("distribution", "bimodal");
      out.quantity("mean2", d.mean2, length);
      out.quantity("sd2", d.sd2, length);
      out.quantity("share2", d.share2, plain);
      break;
    default:
      out.text("distribution", "table");
  }
  if (d.law == SizeLaw::normal || d.law == SizeLaw::bimodal) {
    out.quantity("mean", d.mean, length);
    out.quantity("sd", d.sd, length);
  }
  if (d.law == SizeLaw::table) {
    std::vector<std::string> edges, shares;
    for (const double edge : d.table_diameter) edges.push_back(number(edge, length));
    for (const double share : d.table_share) shares.push_back(number(share, plain));
    out.raw("diameters", fmt::format("[{}]", fmt::join(edges, ", ")));
    out.raw("shares", fmt::format("[{}]", fmt::join(shares, ", ")));
  } else {
    out.quantity("min", d.min, length);
    out.quantity("max", d.max, length);
  }
  out.text("weight", d.weight == SizeWeight::mass ? "mass" : "number");
}

void write_list(Writer& out, const ListInsertion& list) {
  out.text("method", "list");
  std::string csv =
      "'''\nx [m],y [m],z [m],diameter [m],vx [m/s],vy [m/s],vz [m/s],wx [rad/s],wy [rad/s],wz [rad/s]\n";
  constexpr std::size_t kUsualRow = 96;  // characters
  csv.reserve(csv.size() + kUsualRow * list.grains.size());
  for (const PlacedGrain& g : list.grains)
    fmt::format_to(std::back_inserter(csv), FMT_COMPILE("{},{},{},{},{},{},{},{},{},{}\n"), g.position.x,
                   g.position.y, g.position.z, g.diameter, g.velocity.x, g.velocity.y, g.velocity.z, g.spin.x,
                   g.spin.y, g.spin.z);
  csv += "'''";
  out.raw("csv", csv);
}

void write_particles(Writer& out, const Particles& group) {
  out.element("particles");
  out.text("name", group.name);
  out.text("material", group.material);
  if (group.rain) {
    out.raw("count", fmt::format("{}", group.count));
    write_diameters(out, group.diameter);
  }
  out.header("particles.insert");
  if (group.list) return write_list(out, *group.list);
  out.text("method", "rain");
  out.text("phase", group.rain->phase);
  out.raw("box", box(group.rain->box));
  out.raw("velocity", vector(group.rain->velocity, Dimension::velocity));
  out.quantity("interval", group.rain->interval, Dimension::time);
}

void write_wall(Writer& out, const Wall& wall) {
  out.element("walls");
  out.text("name", wall.name);
  out.text("material", wall.material);
  if (const auto* plane = std::get_if<Plane>(&wall.shape)) {
    out.raw("shape", fmt::format("{{ plane = {{ point = {}, normal = {} }} }}",
                                 vector(plane->point, Dimension::length),
                                 vector(plane->normal, Dimension::dimensionless)));
  } else {
    const Box& solid = std::get<Box>(wall.shape);
    out.raw("shape", fmt::format("{{ box = {{ lo = {}, hi = {} }} }}", vector(solid.lo, Dimension::length),
                                 vector(solid.hi, Dimension::length)));
  }
  out.flag("watch", wall.watch);
  for (const Motion& motion : wall.motion) {
    out.element("walls.motion");
    out.text("phase", motion.phase);
    out.raw("velocity", vector(motion.velocity, Dimension::velocity));
  }
}

void write_phase(Writer& out, const Phase& phase) {
  out.element("phases");
  out.text("name", phase.name);
  if (phase.duration) return out.quantity("duration", *phase.duration, Dimension::time);
  out.header("phases.until");
  out.flag("inserted", phase.until_inserted);
  out.flag("settled", phase.until_settled);
  out.quantity("at_most", phase.at_most, Dimension::time);
  out.quantity("settled_energy", phase.settled_energy, Dimension::dimensionless);
  out.quantity("settled_time", phase.settled_time, Dimension::time);
}

void write_time(Writer& out, const Scene& scene) {
  out.header("time");
  const TimeStep& step = scene.step;
  if (step.fixed) {
    out.quantity("step", *step.fixed, Dimension::time);
  } else {
    out.raw("step", fmt::format("{{ rayleigh = {}, collision = {} }}",
                                number(step.rayleigh, Dimension::dimensionless),
                                number(step.collision, Dimension::dimensionless)));
  }
  out.flag("allow_unstable", step.allow_unstable);
  out.flag("sleeping", step.sleeping);
  out.quantity("sleep_tolerance", step.sleep_tolerance, Dimension::dimensionless);
  if (step.short_below) out.quantity("short_steps_below", *step.short_below, Dimension::length);
  out.raw("seed", fmt::format("{}", scene.seed));
}

void write_field(Writer& out, const Field& field) {
  out.element("fields");
  out.text("name", field.name);
  out.quantity("voxel", field.voxel, Dimension::length);
  out.raw("box", box(field.box));
  if (field.every) out.quantity("every", *field.every, Dimension::time);
  out.quantity("average", field.average, Dimension::length);
  out.text("average_window", name_of(field.average_window));
  out.flag("scales", field.scales);
  out.text("method", method_text(field.recipe));
  out.text("overlap", field.recipe.united ? "union" : "sum");
  std::vector<std::string> quantities;
  for (const std::string& word : quantity_words(field.recipe)) quantities.push_back(quoted(word));
  out.raw("quantities", fmt::format("[{}]", fmt::join(quantities, ", ")));
  out.text("classes", classes_text(field.recipe));
  std::vector<std::string> slices, lines;
  for (const Slice& slice : field.slices)
    slices.push_back(
        quoted(fmt::format("{}={}", "xyz"[slice.axis], format_exact(slice.at, Dimension::length))));
  for (const Line& line : field.lines) {
    std::vector<std::string> places;
    for (int axis = 0; axis < 3; ++axis)
      if (axis != line.axis)
        places.push_back(fmt::format("{}={}", "xyz"[axis], format_exact(line.at[axis], Dimension::length)));
    lines.push_back(quoted(fmt::format("{}@{}", "xyz"[line.axis], fmt::join(places, ","))));
  }
  out.raw("slices", fmt::format("[{}]", fmt::join(slices, ", ")));
  out.raw("lines", fmt::format("[{}]", fmt::join(lines, ", ")));
  out.flag("periodic_from_domain", field.periodic_from_domain);
  const FieldLayers& layers = field.layers;
  out.raw("layers",
          fmt::format("{{ z = [{}, {}], columns = [{}, {}] }}", number(layers.z_lo, Dimension::length),
                      number(layers.z_hi, Dimension::length), layers.columns[0], layers.columns[1]));
}

}  // namespace

std::string resolved_toml(const Scene& scene) {
  Writer out;
  out.text("title", scene.title);
  write_domain(out, scene.domain);
  for (const Material& material : scene.materials) {
    out.header(fmt::format("materials.{}", material.name));
    out.quantity("density", material.density, Dimension::density);
    out.quantity("youngs_modulus", material.youngs_modulus, Dimension::pressure);
    out.quantity("poisson_ratio", material.poisson_ratio, Dimension::dimensionless);
  }
  write_contact(out, scene.contact);
  for (const Particles& group : scene.particles) write_particles(out, group);
  for (const Wall& wall : scene.walls) write_wall(out, wall);
  for (const Phase& phase : scene.phases) write_phase(out, phase);
  write_time(out, scene);
  out.header("output");
  out.quantity("trajectory", scene.output.trajectory, Dimension::time);
  out.quantity("series", scene.output.series, Dimension::time);
  out.quantity("checkpoint", scene.output.checkpoint, Dimension::time);
  out.flag("energy", scene.output.energy);
  for (const Field& field : scene.fields) write_field(out, field);
  return out.take();
}

}  // namespace interstice::scene
