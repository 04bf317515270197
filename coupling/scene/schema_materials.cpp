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
     .words = "hooke hertz",
     .about = "the elastic normal force: `hooke` in proportion to the overlap, `hertz` to its power of 3/2"},
    {.name = "stiffness_rule",
     .kind = Kind::choice,
     .fallback = "given",
     .words = "given overlap velocity",
     .law = "normal hooke",
     .about = "with `hooke` alone: how it gets its stiffness (see above)"},
    {.name = "design_speed",
     .dimension = Dimension::velocity,
     .range = positive("a stiffness follows from it"),
     .plausible = {1e-5, 1e3},
     .law = "stiffness_rule overlap velocity",
     .due = true,
     .about = "of the fastest impact; required with the rules `overlap` and `velocity`, an error without"},
    {.name = "overlap_limit",
     .range = {.lo = 0, .hi = 0.5, .lo_open = true, .reason = "a grain cannot be pressed in farther"},
     .plausible = {1e-5, 0.1},
     .law = "stiffness_rule overlap",
     .due = true,
     .about = "the deepest overlap, in diameters; required with the rule `overlap`, an error without"},
    {.name = "damping",
     .kind = Kind::choice,
     .fallback = "tension",
     .words = "tension clipped clipped_uncorrected",
     .about =
         "`tension`: the dashpot may turn the force attractive on separation; `clipped`: it may not, and "
         "is corrected so that the restitution holds; `clipped_uncorrected`: it may not, and grains "
         "rebound higher than `restitution` says"},
    {.name = "tangential",
     .kind = Kind::choice,
     .fallback = "none",
     .words = "none slider mindlin",
     .about = "sliding friction; `slider`: against the slip, without a spring; `mindlin`: a spring with "
              "history, up to the friction"},
    {.name = "slider_velocity",
     .dimension = Dimension::velocity,
     .fallback = "1 mm/s",
     .range = positive("friction would jump where the slip turns"),
     .plausible = {1e-9, 1},
     .law = "tangential slider",
     .about = "with `slider` alone: below this slip friction falls off in proportion to it"},
    {.name = "rolling",
     .kind = Kind::choice,
     .fallback = "none",
     .words = "none cdt epsd2",
     .about = "rolling friction; `cdt`: constant directional torque; `epsd2`: an elastic-plastic spring "
              "without a dashpot"},
    {.name = "cohesion",
     .kind = Kind::choice,
     .fallback = "none",
     .words = "none sjkr jkr dmt van_der_waals",
     .about = "attraction; `sjkr`: energy density times contact area; `jkr` (with `hertz` alone) and `dmt`: "
              "adhesion of soft and of stiff contacts; `van_der_waals`: also at a distance"},
    {.name = "pair", .kind = Kind::tables, .about = "one table a pair of materials that can meet"},
};

/// Adhesion beyond this is no material's, and doubling it must not overflow.
constexpr Range kAdhesion{.lo = 0, .hi = 1e6, .reason = "adhesion attracts, and no bond is stronger"};
/// The same for separations, of which the range is a hundredfold.
constexpr Range kSeparation{
    .lo = 0, .hi = 1e-2, .lo_open = true, .reason = "the force would have no end, or reach too far"};

constexpr Key kPair[] = {
    {.name = "materials", .kind = Kind::texts, .required = true, .about = "the two materials, in any order"},
    {.name = "restitution",
     .required = true,
     .range = {.lo = 0, .hi = 1, .reason = "an impact returns between none and all of the relative speed"},
     .about = "coefficient of restitution"},
    {.name = "stiffness",
     .dimension = Dimension::stiffness,
     .range = positive("a contact needs a stiffness"),
     .plausible = {1e-3, 1e9},
     .law = "stiffness_rule given",
     .due = true,
     .about = "required with `hooke` and the rule `given`, an error without"},
    {.name = "friction",
     .range = not_negative("friction opposes sliding"),
     .plausible = {0, 10},
     .law = "tangential slider mindlin",
     .due = true,
     .about = "sliding friction; required with a tangential law, an error without"},
    {.name = "rolling_friction",
     .range = not_negative("friction opposes rolling"),
     .plausible = {0, 10},
     .law = "rolling cdt epsd2",
     .due = true,
     .about = "rolling friction; required with a rolling law, an error without"},
    {.name = "cohesion_energy_density",
     .dimension = Dimension::energy_density,
     .range = not_negative("cohesion attracts"),
     .plausible = {0, 1e9},
     .law = "cohesion sjkr",
     .due = true,
     .about = "required with `sjkr`, an error without"},
    {.name = "work_of_adhesion",
     .dimension = Dimension::surface_energy,
     .range = kAdhesion,
     .plausible = {0, 10},
     .law = "cohesion jkr dmt",
     .about = "w, what it takes to part the two surfaces; with `jkr` or `dmt` required, or else:"},
    {.name = "surface_energy",
     .dimension = Dimension::surface_energy,
     .range = kAdhesion,
     .plausible = {0, 5},
     .law = "cohesion jkr dmt",
     .about = "gamma, of each of the two surfaces: w = 2 gamma"},
    {.name = "hamaker_constant",
     .dimension = Dimension::energy,
     .range = not_negative("van der Waals forces attract"),
     .plausible = {1e-22, 1e-17},
     .law = "cohesion van_der_waals",
     .due = true,
     .about = "required with `van_der_waals`, an error without"},
    {.name = "cutoff",
     .dimension = Dimension::length,
     .range = kSeparation,
     .plausible = {0.05e-9, 100e-9},
     .law = "cohesion van_der_waals",
     .due = true,
     .about = "separation below which the force stays constant, about 0.165 nm for molecular contact; "
              "required with `van_der_waals`, an error without"},
    {.name = "range",
     .dimension = Dimension::length,
     .range = positive("the force reaches some way"),
     .plausible = {0.1e-9, 100e-6},
     .law = "cohesion van_der_waals",
     .about = "with `van_der_waals` alone: separation beyond which there is no force; default: 100 times the "
              "cutoff"},
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
