// Keys of the file itself, of space, materials and contacts.
#include "coupling/scene/schema_tables.h"

namespace interstice::scene {
namespace {

constexpr Key kRoot[] = {
    {.name = "title", .kind = Kind::text, .about = "free text"},
    {.name = "domain", .kind = Kind::table, .required = true, .about = "space and gravity"},
    {.name = "materials", .kind = Kind::special, .about = "one table a material"},
    {.name = "contact", .kind = Kind::table, .about = "the laws of contact"},
    {.name = "particles", .kind = Kind::tables, .about = "groups of grains"},
    {.name = "walls", .kind = Kind::tables, .about = "walls and tools"},
    {.name = "phases", .kind = Kind::tables, .required = true, .about = "what happens, one after the other"},
    {.name = "time", .kind = Kind::table, .about = "time step and seed"},
    {.name = "output", .kind = Kind::table, .about = "what is written, how often"},
    {.name = "fields", .kind = Kind::tables, .about = "void-fraction fields"},
};

constexpr Key kDomain[] = {
    {.name = "box",
     .kind = Kind::box,
     .dimension = Dimension::length,
     .required = true,
     .about = "the space that grains live in; walls may reach beyond it"},
    {.name = "boundary",
     .kind = Kind::choices,
     .fallback = "open",
     .words = "open wall periodic",
     .about =
         "per axis: `open` (grains that leave are counted and removed), `wall` (flat walls at both ends) or "
         "`periodic`"},
    {.name = "wall_material",
     .kind = Kind::special,
     .about =
         "the material of `wall` boundaries: one name, or one per axis (\"\" where the axis is no wall); "
         "required where a boundary is `wall`"},
    {.name = "gravity",
     .kind = Kind::vector,
     .dimension = Dimension::acceleration,
     .fallback = "0 m/s^2, 0 m/s^2, -9.81 m/s^2",
     .plausible = {-1e4, 1e4},
     .about = "acceleration of free fall"},
};

constexpr Key kMaterial[] = {
    {.name = "density",
     .dimension = Dimension::density,
     .required = true,
     .range = positive("grains need a mass"),
     .plausible = {1, 25000},
     .about = "of the solid itself, without voids"},
    {.name = "youngs_modulus",
     .dimension = Dimension::pressure,
     .required = true,
     .range = positive("a contact needs a stiffness"),
     .plausible = {1e4, 2e12},
     .about = "Young's modulus"},
    {.name = "poisson_ratio",
     .required = true,
     .range = {.lo = -1, .hi = 0.5, .lo_open = true, .reason = "an isotropic solid is unstable beyond"},
     .about = "Poisson's ratio"},
};

constexpr Key kContact[] = {
    {.name = "normal",
     .kind = Kind::choice,
     .fallback = "hertz",
     .words = "hertz",
     .later = "hooke",
     .about = "the elastic normal force"},
    {.name = "damping",
     .kind = Kind::choice,
     .fallback = "tension",
     .words = "tension clipped",
     .about = "`tension`: the dashpot may turn the force attractive on separation; `clipped`: it may not"},
    {.name = "tangential",
     .kind = Kind::choice,
     .fallback = "none",
     .words = "none mindlin",
     .later = "slider",
     .about = "sliding friction"},
    {.name = "rolling",
     .kind = Kind::choice,
     .fallback = "none",
     .words = "none cdt",
     .later = "epsd2",
     .about = "rolling friction; `cdt`: constant directional torque"},
    {.name = "cohesion",
     .kind = Kind::choice,
     .fallback = "none",
     .words = "none sjkr",
     .later = "jkr dmt van_der_waals",
     .about = "attraction; `sjkr`: energy density times contact area"},
    {.name = "pair", .kind = Kind::tables, .about = "one table a pair of materials that can meet"},
};

constexpr Key kPair[] = {
    {.name = "materials", .kind = Kind::texts, .required = true, .about = "the two materials, in any order"},
    {.name = "restitution",
     .required = true,
     .range = {.lo = 0, .hi = 1, .reason = "an impact returns between none and all of the relative speed"},
     .about = "coefficient of restitution"},
    {.name = "friction",
     .range = not_negative("friction opposes sliding"),
     .plausible = {0, 10},
     .about = "sliding friction; required with a tangential law, an error without"},
    {.name = "rolling_friction",
     .range = not_negative("friction opposes rolling"),
     .plausible = {0, 10},
     .about = "rolling friction; required with a rolling law, an error without"},
    {.name = "cohesion_energy_density",
     .dimension = Dimension::energy_density,
     .range = not_negative("cohesion attracts"),
     .plausible = {0, 1e9},
     .about = "required with `sjkr`, an error without"},
};

constexpr Section kSections[] = {
    {"", "Its sections, and a title", kRoot},
    {"domain", "Space and gravity", kDomain},
    {"materials.NAME", "One table per material", kMaterial},
    {"contact", "The laws of contact; what is not named is not modelled and costs nothing", kContact},
    {"contact.pair", "Every pair of materials that can meet, once", kPair},
};

}  // namespace

std::span<const Section> material_sections() { return kSections; }

}  // namespace interstice::scene
