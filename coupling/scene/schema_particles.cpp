// Keys of groups of grains: sizes and insertion.
#include "coupling/scene/schema_tables.h"

namespace interstice::scene {
namespace {

constexpr std::string_view kPowder = "grains of powder are of finite size";
constexpr Plausible kGrain{100e-9, 1e-2};

constexpr Key kParticles[] = {
    {.name = "name", .kind = Kind::name, .required = true, .about = "of the group"},
    {.name = "material", .kind = Kind::text, .required = true, .about = "one of [materials]"},
    {.name = "count",
     .kind = Kind::integer,
     .range = {.lo = 1,
               .hi = 2147483647,
               .reason = "a group has at least one grain, and grains are counted in 32 bits"},
     .about = "grains in the group; required with `rain`, known from the list with `list`"},
    {.name = "diameter",
     .kind = Kind::special,
     .about = "one quantity, or a distribution; required with `rain`, known from the list with `list`"},
    {.name = "insert", .kind = Kind::table, .required = true, .about = "how the grains come in"},
};

constexpr Key kRain[] = {
    {.name = "method", .kind = Kind::choice, .required = true, .words = "rain list", .about = "`rain`"},
    {.name = "phase", .kind = Kind::text, .required = true, .about = "the phase it rains in"},
    {.name = "box",
     .kind = Kind::box,
     .dimension = Dimension::length,
     .required = true,
     .about = "grains appear wholly inside, where there is room"},
    {.name = "velocity",
     .kind = Kind::vector,
     .dimension = Dimension::velocity,
     .fallback = "0 m/s, 0 m/s, 0 m/s",
     .plausible = {-100, 100},
     .about = "of the grains as they appear"},
    {.name = "interval",
     .dimension = Dimension::time,
     .fallback = "0.5 ms",
     .range = positive("time goes on between two attempts"),
     .about = "time between attempts to place grains"},
};

constexpr Key kList[] = {
    {.name = "method", .kind = Kind::choice, .required = true, .words = "rain list", .about = "`list`"},
    {.name = "file", .kind = Kind::text, .about = "a CSV file beside the scene; or else:"},
    {.name = "csv", .kind = Kind::text, .about = "the same text, written in the scene itself"},
};

constexpr Key kSingle[] = {
    {.name = "distribution",
     .kind = Kind::choice,
     .required = true,
     .words = "single normal lognormal uniform bimodal table",
     .about = "`single`"},
    {.name = "mean",
     .dimension = Dimension::length,
     .required = true,
     .range = positive(kPowder),
     .plausible = kGrain,
     .about = "the diameter; short form: `diameter = \"40 um\"`"},
};
constexpr Key kMin{.name = "min",
                   .dimension = Dimension::length,
                   .required = true,
                   .range = positive(kPowder),
                   .plausible = kGrain,
                   .about = "no grain is smaller; the smallest sets the time step"};
constexpr Key kMax{.name = "max",
                   .dimension = Dimension::length,
                   .required = true,
                   .range = positive(kPowder),
                   .plausible = kGrain,
                   .about = "no grain is larger"};
constexpr Key kWeight{.name = "weight",
                      .kind = Kind::choice,
                      .fallback = "number",
                      .words = "number mass",
                      .about = "whether the distribution is one of the number or of the mass of grains"};
constexpr Range kSpread = positive("for one size write diameter = \"40 um\" instead");

constexpr Key kNormal[] = {
    {.name = "distribution",
     .kind = Kind::choice,
     .required = true,
     .words = "single normal lognormal uniform bimodal table",
     .about = "`normal`"},
    {.name = "mean",
     .dimension = Dimension::length,
     .required = true,
     .range = positive(kPowder),
     .plausible = kGrain,
     .about = "of the curve before it is cut to [min, max]"},
    {.name = "sd",
     .dimension = Dimension::length,
     .required = true,
     .range = kSpread,
     .about = "standard deviation of the curve before it is cut"},
    kMin,
    kMax,
    kWeight,
};
constexpr Key kLognormal[] = {
    {.name = "distribution",
     .kind = Kind::choice,
     .required = true,
     .words = "single normal lognormal uniform bimodal table",
     .about = "`lognormal`"},
    {.name = "median",
     .dimension = Dimension::length,
     .required = true,
     .range = positive(kPowder),
     .plausible = kGrain,
     .about = "of the curve before it is cut to [min, max]"},
    {.name = "sigma",
     .required = true,
     .range = kSpread,
     .plausible = {0, 3},
     .about = "standard deviation of ln(diameter), a plain number"},
    kMin,
    kMax,
    kWeight,
};
constexpr Key kUniform[] = {
    {.name = "distribution",
     .kind = Kind::choice,
     .required = true,
     .words = "single normal lognormal uniform bimodal table",
     .about = "`uniform`"},
    kMin,
    kMax,
    kWeight,
};
constexpr Key kBimodal[] = {
    {.name = "distribution",
     .kind = Kind::choice,
     .required = true,
     .words = "single normal lognormal uniform bimodal table",
     .about = "`bimodal`: two normal modes"},
    {.name = "mean",
     .dimension = Dimension::length,
     .required = true,
     .range = positive(kPowder),
     .plausible = kGrain,
     .about = "of the first mode"},
    {.name = "sd",
     .dimension = Dimension::length,
     .required = true,
     .range = kSpread,
     .about = "of the first mode"},
    {.name = "mean2",
     .dimension = Dimension::length,
     .required = true,
     .range = positive(kPowder),
     .plausible = kGrain,
     .about = "of the second mode"},
    {.name = "sd2",
     .dimension = Dimension::length,
     .required = true,
     .range = kSpread,
     .about = "of the second mode"},
    {.name = "share2",
     .required = true,
     .range = {.lo = 0, .hi = 1, .reason = "it is a share of the whole"},
     .about = "the second mode's share of the number (or mass, as `weight` says)"},
    kMin,
    kMax,
    kWeight,
};
constexpr Key kTable[] = {
    {.name = "distribution",
     .kind = Kind::choice,
     .required = true,
     .words = "single normal lognormal uniform bimodal table",
     .about = "`table`: classes of a sieve or laser"},
    {.name = "diameters",
     .kind = Kind::list,
     .dimension = Dimension::length,
     .required = true,
     .range = positive(kPowder),
     .plausible = kGrain,
     .about = "edges of the classes, rising, one more than shares"},
    {.name = "shares",
     .kind = Kind::list,
     .required = true,
     .range = not_negative("a class holds some or none"),
     .about = "per class; they need not sum to one"},
    kWeight,
};

constexpr Section kSections[] = {
    {"particles", "Groups of grains", kParticles},
    {"particles.insert (rain)", "Grains appear over time, as room is found", kRain},
    {"particles.insert (list)", "Grains at given places from the start", kList},
    {"particles.diameter (single)", "All grains of one size", kSingle},
    {"particles.diameter (normal)", "A normal curve, cut", kNormal},
    {"particles.diameter (lognormal)", "A log-normal curve, cut", kLognormal},
    {"particles.diameter (uniform)", "All sizes alike", kUniform},
    {"particles.diameter (bimodal)", "Two normal curves, cut", kBimodal},
    {"particles.diameter (table)", "Classes, as measured", kTable},
};

}  // namespace

std::span<const Section> particle_sections() { return kSections; }

}  // namespace interstice::scene
