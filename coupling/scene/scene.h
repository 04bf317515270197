// What a scene file says, typed, validated, in SI units. Nothing changes a Scene after read_scene() made it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/averaging_window.h"
#include "base/shapes.h"
#include "coupling/scene/field_recipe.h"

namespace interstice::scene {

enum class Boundary { open, wall, periodic };
enum class NormalLaw { hooke, hertz };
enum class StiffnessRule { given, overlap, velocity };  // how hooke gets its stiffness
enum class Damping { tension, clipped, clipped_uncorrected };
enum class TangentialLaw { none, slider, mindlin };
enum class RollingLaw { none, cdt, epsd2 };
enum class CohesionLaw { none, sjkr, jkr, dmt, van_der_waals };

struct Domain {
  Box box;
  std::array<Boundary, 3> boundary{Boundary::open, Boundary::open, Boundary::open};
  std::array<std::string, 3> wall_material;  // per axis, where the boundary is a wall
  Vec3d gravity{0, 0, -9.81};                // [m/s^2]

  bool operator==(const Domain&) const = default;
};

struct Material {
  std::string name;
  double density = 0;         // [kg/m^3]
  double youngs_modulus = 0;  // [Pa]
  double poisson_ratio = 0;   // [-]

  bool operator==(const Material&) const = default;
};

/// Of these, a pair has those that its laws need; the others are zero.
struct ContactPair {
  std::array<std::string, 2> materials;
  double restitution = 0;              // [-]
  double stiffness = 0;                // hooke, rule given [N/m]
  double friction = 0;                 // [-]
  double rolling_friction = 0;         // [-]
  double cohesion_energy_density = 0;  // sjkr [J/m^3]
  double work_of_adhesion = 0;         // jkr, dmt: w = 2 gamma [J/m^2]
  double hamaker_constant = 0;         // van_der_waals [J]
  double cutoff = 0;                   // van_der_waals: below this separation the force is constant [m]
  double range = 0;                    // van_der_waals: beyond this separation there is none [m]

  bool operator==(const ContactPair&) const = default;
};

struct Contact {
  NormalLaw normal = NormalLaw::hertz;
  StiffnessRule stiffness_rule = StiffnessRule::given;
  double design_speed = 0;   // rules overlap and velocity: of the fastest impact [m/s]
  double overlap_limit = 0;  // rule overlap: the deepest overlap in diameters [-]
  Damping damping = Damping::tension;
  TangentialLaw tangential = TangentialLaw::none;
  double slider_velocity = 0;  // slider: slip below which friction falls off in proportion [m/s]
  RollingLaw rolling = RollingLaw::none;
  CohesionLaw cohesion = CohesionLaw::none;
  std::vector<ContactPair> pairs;

  bool operator==(const Contact&) const = default;
};

enum class SizeLaw { single, normal, lognormal, uniform, bimodal, table };
enum class SizeWeight { number, mass };

/// A distribution of diameters [m], truncated to [min, max]. By number, or by mass (then the density given is
/// that of mass over diameter, and the numbers follow from it).
struct Diameters {
  SizeLaw law = SizeLaw::single;
  SizeWeight weight = SizeWeight::number;
  double mean = 0,
         sd = 0;  // single: mean; normal: both [m]; lognormal: mean is the median [m], sd that of ln d [-]
  double mean2 = 0, sd2 = 0;  // bimodal: the second normal mode [m]
  double share2 = 0;          // bimodal: the second mode's share (of number or mass, as `weight` says)
  double min = 0, max = 0;    // [m]
  std::vector<double> table_diameter, table_share;  // table: class edges (n + 1) [m], shares (n)

  bool operator==(const Diameters&) const = default;
};

struct RainInsertion {
  std::string phase;         // inserted during this phase
  Box box;                   // grains lie wholly inside it
  Vec3d velocity{0, 0, 0};   // [m/s]
  double interval = 0.5e-3;  // time between attempts [s]

  bool operator==(const RainInsertion&) const = default;
};

/// One grain of a placement list.
struct PlacedGrain {
  Vec3d position;           // [m]
  double diameter = 0;      // [m]
  Vec3d velocity{0, 0, 0};  // [m/s]
  Vec3d spin{0, 0, 0};      // [rad/s]

  bool operator==(const PlacedGrain&) const = default;
};
struct ListInsertion {
  std::string file;  // where the grains came from, for messages
  std::vector<PlacedGrain> grains;

  bool operator==(const ListInsertion& other) const { return grains == other.grains; }
};

struct Particles {
  std::string name;
  std::string material;
  std::int64_t count = 0;
  Diameters diameter;                 // rain only
  std::optional<RainInsertion> rain;  // exactly one of the two
  std::optional<ListInsertion> list;

  bool operator==(const Particles&) const = default;
};

struct Motion {
  std::string phase;
  Vec3d velocity{0, 0, 0};  // [m/s]

  bool operator==(const Motion&) const = default;
};

struct Wall {
  std::string name;
  std::string material;
  Shape shape;
  bool watch = false;  // columns of its own in series.csv
  std::vector<Motion> motion;

  bool operator==(const Wall&) const = default;
};

struct Phase {
  std::string name;
  std::optional<double> duration;  // [s]; or until:
  bool until_inserted = false;
  bool until_settled = false;
  double at_most = 0;            // [s]
  double settled_energy = 1e-3;  // kinetic energy per grain below this fraction of m g d ...
  double settled_time = 1e-3;    // ... for this long [s]

  bool operator==(const Phase&) const = default;
};

struct TimeStep {
  double rayleigh = 0.2;          // fraction of the Rayleigh time
  double collision = 0.04;        // fraction of the collision time
  std::optional<double> fixed;    // [s], instead of the two
  bool allow_unstable = false;    // lets a fixed step above 0.2 of the collision time through
  bool sleeping = false;          // grains at rest are left out of steps ...
  double sleep_tolerance = 0.05;  // ... until forces on them are out of balance by this share of their weight

  std::optional<double> short_below;  // grains of a smaller diameter take shorter steps [m]

  bool operator==(const TimeStep&) const = default;
};

struct Output {
  double trajectory = 0;  // interval [s]; 0: none
  double series = 0;      // interval [s]; 0: none
  double checkpoint = 0;  // interval of wall-clock seconds [s]; 0: only at the end and at a stop
  bool energy = false;    // energies and what each mechanism dissipated, in the series

  bool operator==(const Output&) const = default;
};

/// "x=4.5 mm": the plane of voxels that holds this coordinate.
struct Slice {
  int axis = 0;
  double at = 0;  // [m]

  bool operator==(const Slice&) const = default;
};
/// "y@x=9 mm,z=35 um": the row of voxels along `axis` through the point (the component of `axis` is ignored).
struct Line {
  int axis = 1;
  Vec3d at;  // [m]

  bool operator==(const Line&) const = default;
};

/// Columns over the field's box, of which the layer's packing and its evenness are computed.
struct FieldLayers {
  double z_lo = 0, z_hi = 0;           // [m]
  std::array<int, 2> columns{40, 10};  // along x and y

  bool operator==(const FieldLayers&) const = default;
};

struct Field {
  std::string name;
  double voxel = 0;  // edge [m]
  Box box;
  std::optional<double> every;  // interval [s]; also at the end of each phase, always
  double average = 0;           // averaging length [m]; 0: none
  WindowShape average_window = WindowShape::box;
  bool scales = false;  // also void fraction against averaging length
  FieldRecipe recipe;
  std::vector<Slice> slices;
  std::vector<Line> lines;
  FieldLayers layers;  // default: the height of the box
  bool periodic_from_domain = true;

  bool operator==(const Field&) const = default;
};

struct Scene {
  std::string file;  // where it came from, for messages
  std::string title;
  Domain domain;
  std::vector<Material> materials;
  Contact contact;
  std::vector<Particles> particles;
  std::vector<Wall> walls;
  std::vector<Phase> phases;
  TimeStep step;
  std::uint64_t seed = 1;
  Output output;
  std::vector<Field> fields;

  bool operator==(const Scene&) const = default;
};

}  // namespace interstice::scene
