// Keys of walls and their motion, of phases, time, output and fields.
#include "coupling/scene/schema_tables.h"

namespace interstice::scene {
namespace {

constexpr std::string_view kSize = "a size is greater than nothing";

constexpr Key kWall[] = {
    {.name = "name", .kind = Kind::name, .required = true, .about = "of the wall, in series.csv too"},
    {.name = "material", .kind = Kind::text, .required = true, .about = "one of [materials]"},
    {.name = "shape", .kind = Kind::table, .required = true, .about = "`plane` or `box`"},
    {.name = "watch",
     .kind = Kind::boolean,
     .fallback = "false",
     .about = "columns of its own in series.csv"},
    {.name = "motion", .kind = Kind::tables, .about = "at rest in every phase that is not named"},
};
constexpr Key kShape[] = {
    {.name = "plane", .kind = Kind::table, .about = "a half-space of solid; or else:"},
    {.name = "box", .kind = Kind::table, .about = "a solid axis-aligned box"},
};
constexpr Key kPlane[] = {
    {.name = "point",
     .kind = Kind::vector,
     .dimension = Dimension::length,
     .required = true,
     .about = "any point of the plane"},
    {.name = "normal",
     .kind = Kind::vector,
     .required = true,
     .about = "towards the powder, away from the solid; any length but zero"},
};
constexpr Key kBox[] = {
    {.name = "center", .kind = Kind::vector, .dimension = Dimension::length, .about = "with `size`"},
    {.name = "size",
     .kind = Kind::vector,
     .dimension = Dimension::length,
     .range = positive(kSize),
     .about = "with `center`"},
    {.name = "lo",
     .kind = Kind::vector,
     .dimension = Dimension::length,
     .about = "with `hi`: the lower corner"},
    {.name = "hi",
     .kind = Kind::vector,
     .dimension = Dimension::length,
     .about = "with `lo`: the upper corner"},
};
constexpr Key kMotion[] = {
    {.name = "phase", .kind = Kind::text, .required = true, .about = "one of [[phases]]"},
    {.name = "velocity",
     .kind = Kind::vector,
     .dimension = Dimension::velocity,
     .required = true,
     .plausible = {-100, 100},
     .about = "throughout that phase"},
};

constexpr Key kPhase[] = {
    {.name = "name", .kind = Kind::name, .required = true, .about = "of the phase"},
    {.name = "duration",
     .dimension = Dimension::time,
     .range = positive("time goes forward"),
     .plausible = {1e-9, 1e4},
     .about = "how long it lasts; or else:"},
    {.name = "until", .kind = Kind::table, .about = "what ends it"},
};
constexpr Key kUntil[] = {
    {.name = "inserted",
     .kind = Kind::boolean,
     .fallback = "false",
     .about = "all grains of the phase are in"},
    {.name = "settled", .kind = Kind::boolean, .fallback = "false", .about = "the grains are at rest"},
    {.name = "at_most",
     .dimension = Dimension::time,
     .required = true,
     .range = positive("time goes forward"),
     .plausible = {1e-9, 1e4},
     .about = "the phase ends then in any case"},
    {.name = "settled_energy",
     .fallback = "0.001",
     .range = positive("grains never rest exactly"),
     .about = "at rest: kinetic energy per grain below this fraction of m g d ..."},
    {.name = "settled_time",
     .dimension = Dimension::time,
     .fallback = "1 ms",
     .range = not_negative("time goes forward"),
     .about = "... for this long"},
};

constexpr Key kTime[] = {
    {.name = "step",
     .kind = Kind::special,
     .about = "a time, or a table of fractions of which the smaller holds"},
    {.name = "allow_unstable",
     .kind = Kind::boolean,
     .fallback = "false",
     .about = "lets a step above 0.2 of the collision time through"},
    {.name = "sleeping",
     .kind = Kind::boolean,
     .fallback = "false",
     .about = "grains at rest sleep, left out of steps, until something disturbs them"},
    {.name = "sleep_tolerance",
     .fallback = "0.05",
     .range = {.lo = 0, .hi = 0.1, .lo_open = true, .reason = "a sleeping grain must be near balance"},
     .plausible = {1e-4, 0.1},
     .about = "share of its weight by which forces on a sleeping grain may be out of balance"},
    {.name = "short_steps_below",
     .dimension = Dimension::length,
     .range = positive("it is a diameter"),
     .plausible = {1e-7, 1e-2},
     .about = "grains of a smaller diameter take several short steps for each step of the others; none: all "
              "take the same"},
    {.name = "seed",
     .kind = Kind::integer,
     .fallback = "1",
     .range = {.lo = 0, .hi = 9223372036854775807.0, .reason = "it numbers the streams of random numbers"},
     .about = "the same seed gives the same bits"},
};
constexpr Key kStep[] = {
    {.name = "rayleigh",
     .fallback = "0.2",
     .range =
         {.lo = 0, .hi = 1, .lo_open = true, .reason = "a Rayleigh wave must not cross a grain in one step"},
     .plausible = {1e-6, 0.4},
     .about = "fraction of the Rayleigh time of the worst grain"},
    {.name = "collision",
     .fallback = "0.04",
     .range = {.lo = 0, .hi = 1, .lo_open = true, .reason = "an impact must be resolved"},
     .plausible = {1e-6, 0.05},
     .about = "fraction of the duration of the worst impact"},
};

constexpr Key kOutput[] = {
    {.name = "trajectory",
     .dimension = Dimension::time,
     .fallback = "0 s",
     .range = not_negative("0 s means never"),
     .about = "interval of trajectory.h5part; 0 s: none"},
    {.name = "series",
     .dimension = Dimension::time,
     .fallback = "0 s",
     .range = not_negative("0 s means never"),
     .about = "interval of series.csv; 0 s: none"},
    {.name = "checkpoint",
     .dimension = Dimension::time,
     .fallback = "0 s",
     .range = not_negative("0 s means only at the end"),
     .about =
         "interval of checkpoint.h5, in time of the clock on the wall; 0 s: only at the end and at a stop"},
    {.name = "energy",
     .kind = Kind::boolean,
     .fallback = "false",
     .about = "columns of energy in series.csv: what there is, and what each mechanism took; needs `series`"},
};

constexpr Key kField[] = {
    {.name = "name", .kind = Kind::name, .required = true, .about = "of the field and its files"},
    {.name = "voxel",
     .dimension = Dimension::length,
     .required = true,
     .range = positive(kSize),
     .plausible = {100e-9, 1e-1},
     .about = "edge of a voxel"},
    {.name = "box",
     .kind = Kind::box,
     .dimension = Dimension::length,
     .required = true,
     .about = "the field's box, inside the domain; extended upward to whole voxels"},
    {.name = "every",
     .dimension = Dimension::time,
     .range = positive("time goes on between two fields"),
     .about = "interval; always at the end of each phase too, and only there when not given"},
    {.name = "average",
     .dimension = Dimension::length,
     .fallback = "0 m",
     .range = not_negative("0 m means none"),
     .about = "also a field averaged over this length, at least a voxel; 0 m: none"},
    {.name = "average_window",
     .kind = Kind::choice,
     .fallback = "box",
     .words = "box sphere gaussian",
     .about = "what `average` is of: a cube's edge, a sphere's diameter, or the edge of the cube that has a "
              "Gaussian's second moments"},
    {.name = "scales",
     .kind = Kind::boolean,
     .fallback = "false",
     .about = "also scales.csv: void fraction against averaging length, over the same window"},
    {.name = "method",
     .kind = Kind::text,
     .fallback = "exact",
     .about = "as `--method` of `voids`: exact, centre, divided[:LEAST_VOID], subsample:N, kernel:LENGTH"},
    {.name = "overlap",
     .kind = Kind::choice,
     .fallback = "sum",
     .words = "sum union",
     .about = "how places count that grains share: once for each, or once"},
    {.name = "quantities",
     .kind = Kind::texts,
     .about = "also velocity, temperature, diameter, coordination, stress, bonded: those wanted"},
    {.name = "classes",
     .kind = Kind::text,
     .fallback = "none",
     .about = "solid fraction by class: `\"size:20um,40um\"`, `\"material\"`, `\"layer\"`"},
    {.name = "slices", .kind = Kind::texts, .about = "planes of voxels: `\"x=4.5 mm\"`"},
    {.name = "lines", .kind = Kind::texts, .about = "rows of voxels: `\"y@x=9 mm,z=35 um\"`"},
    {.name = "layers", .kind = Kind::table, .about = "columns for the statistics of the layer"},
    {.name = "periodic_from_domain",
     .kind = Kind::boolean,
     .fallback = "true",
     .about = "grains count across the domain's periodic ends"},
};
constexpr Key kLayers[] = {
    {.name = "z",
     .kind = Kind::interval,
     .dimension = Dimension::length,
     .about = "height of the columns, such as substrate to blade; default: that of the field's box"},
    {.name = "columns", .kind = Kind::special, .fallback = "40, 10", .about = "columns along x and y"},
};

constexpr Section kSections[] = {
    {"walls", "Walls and tools", kWall},
    {"walls.shape", "One of the two", kShape},
    {"walls.shape.plane", "A half-space of solid", kPlane},
    {"walls.shape.box", "A solid box: `center` and `size`, or `lo` and `hi`", kBox},
    {"walls.motion", "How the wall moves", kMotion},
    {"phases", "What happens, one after the other", kPhase},
    {"phases.until", "What ends a phase", kUntil},
    {"time", "Time step and seed", kTime},
    {"time.step", "The smaller of the two", kStep},
    {"output", "What is written, how often", kOutput},
    {"fields", "Void-fraction fields", kField},
    {"fields.layers", "Columns for the statistics of the layer", kLayers},
};

}  // namespace

std::span<const Section> course_sections() { return kSections; }

}  // namespace interstice::scene
