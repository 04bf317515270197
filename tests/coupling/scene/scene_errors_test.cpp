// Every class of input error, made from a good scene by one change: exactly one message, at the right line,
// saying the right thing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "coupling/scene/read_scene.h"
#include "tests/coupling/scene/example_scene.h"

namespace interstice::scene {
namespace {

struct Change {
  std::string_view from, to;  // the one change
  std::string line;  // a text of the changed scene that stands on the line where the error is; empty: `to`
  std::string_view fragment;  // of the message
};

const Change kChanges[] = {
    // keys
    {"density = \"8200", "densty = \"8200", "[materials.powder]",
     "materials.powder.density: is missing; it has no default; add density = \"8200 kg/m^3\""},
    {"title =", "titel =", "", "titel: unknown key; allowed here: title, domain"},
    {"seed = 7", "sede = 7", "", "did you mean \"seed\"?"},
    {"watch = true", "watch = true\nzzzzzzzz = 1", "zzzz",
     "walls.substrate.zzzzzzzz: unknown key; allowed here: name, material, shape, watch, motion; remove it"},
    {"at_most = \"100 ms\"", "atmost = \"100 ms\"", "", "phases.pour.until.at_most: is missing"},
    {"collision = 0.04", "collide = 0.04", "", "did you mean \"collision\"?"},
    // kinds
    {"seed = 7", "seed = \"7\"", "", "time.seed: is a text; an integer is due"},
    {"seed = 7", "seed = 7.5", "", "time.seed: is a number; an integer is due"},
    {"seed = 7", "seed = -1", "", "time.seed: -1 cannot be"},
    {"watch = true", "watch = 1", "", "walls.substrate.watch: is an integer; true or false is due"},
    {"title = \"Example\"", "title = 3", "", "title: is an integer; a text is due"},
    {"title = \"Example\"", "title = 1979-05-27", "", "title: is a date"},
    {"poisson_ratio = 0.3\n", "poisson_ratio = true\n", "",
     "poisson_ratio: is true or false; a plain number is due"},
    {"boundary = [\"open\", \"wall\", \"open\"]", "boundary = \"wall\"", "",
     "domain.boundary: is not a list of three"},
    {"gravity = [\"0 m/s^2\", ", "gravity = [", "", "domain.gravity: is not a list of three"},
    {"slices = [\"x=0.5 mm\", \"x=1 mm\"]", "slices = \"x=0.5 mm\"", "",
     "fields.layer.slices: is a text; an array is due"},
    {"[\"x=0.5 mm\", ", "[5, ", "", "fields.layer.slices.0: is an integer; a text in quotes is due"},
    {"[output]", "[[output]]", "", "output: is an array; a table with these keys is due"},
    {"[[contact.pair]]\nmaterials = [\"powder\", \"powder\"]", "[[contact.pair]]\nmaterials = [\"powder\"]",
     "[\"powder\"]", "has 1 names; two materials meet"},
    // units
    {"density = \"8200 kg/m^3\"", "density = 8200", "",
     "materials.powder.density: 8200 has no unit; a density is due (SI: kg/m^3); write \"8200 kg/m^3\""},
    {"\"8200 kg/m^3\"", "\"8200\"", "", "8200 has no unit"},
    {"\"8200 kg/m^3\"", "\"8200 kg/m^2\"", "", "\"kg/m^2\" is the unit of something else"},
    {"voxel = \"17.3 um\"", "voxel = \"17.3 us\"", "",
     "fields.layer.voxel: \"17.3 us\": \"us\" is the unit of a time; a length is due (SI: m)"},
    {"\"-9.81 m/s^2\"", "-9.81", "", "domain.gravity.2: -9.81 has no unit"},
    {"\"1 MJ/m^3\"", "\"1 MJ/m^2\"", "", "is the unit of a surface energy; an energy density is due"},
    {"restitution = \"35 %\"", "restitution = \"35 m\"", "",
     "is the unit of a length; a plain number or a percentage is due"},
    {"poisson_ratio = 0.3\n", "poisson_ratio = nan\n", "",
     "materials.powder.poisson_ratio: is not a finite number"},
    {"poisson_ratio = 0.3\n", "poisson_ratio = -inf\n", "", "is not a finite number"},
    {"every = \"10 ms\"", "every = \"1e400 ms\"", "", "too large or too small"},
    {"trajectory = \"10 ms\"", "trajectory = \"nan s\"", "", "does not start with a finite decimal number"},
    // ranges
    {"density = \"8200 kg/m^3\"", "density = \"0 kg/m^3\"", "",
     "0 kg/m^3 cannot be: grains need a mass; allowed: greater than 0 kg/m^3"},
    {"density = \"8200 kg/m^3\"", "density = \"-5 kg/m^3\"", "", "-5 kg/m^3 cannot be"},
    {"poisson_ratio = 0.3\n", "poisson_ratio = 0.51\n", "",
     "an isotropic solid is unstable beyond; allowed: greater than -1 and at most 0.5"},
    {"poisson_ratio = 0.3\n", "poisson_ratio = -1\n", "", "-1 cannot be"},
    {"poisson_ratio = 0.29", "poisson_ratio = -1.5", "", "materials.steel.poisson_ratio"},
    {"restitution = 0.35", "restitution = 1.2", "", "contact.pair.powder-powder.restitution: 1.2 cannot be"},
    {"restitution = 0.35", "restitution = -0.1", "", "allowed: 0 to 1"},
    {"friction = 0.3\n", "friction = -0.3\n", "", "-0.3 cannot be: friction opposes sliding"},
    {"rolling_friction = 0.006", "rolling_friction = -1", "", "contact.pair.steel-powder.rolling_friction"},
    {"\"10 kJ/m^3\"", "\"-10 kJ/m^3\"", "", "cohesion attracts"},
    {"count = 1000", "count = 0", "", "particles.feed.count: 0 cannot be"},
    {"count = 1000", "count = 2147483648", "", "allowed: 1 to 2147483647"},
    {"rayleigh = 0.2", "rayleigh = 0", "", "time.step.rayleigh: 0 cannot be"},
    {"collision = 0.04", "collision = 0.3", "", "impacts would gain energy"},
    {"step = { rayleigh = 0.2, collision = 0.04 }", "step = \"0 ns\"", "",
     "time.step: 0 s cannot be: time goes forward"},
    {"duration = \"40 ms\"", "duration = \"-40 ms\"", "", "phases.spread.duration: -40 ms cannot be"},
    {"series = \"0.1 ms\"", "energy = true", "",
     "output.energy: is true, and there is no series to hold it; it is allowed with output.series above 0 s; "
     "add series = \"1 ms\", or drop this key"},
    {"series = \"0.1 ms\"", "series = \"0.1 ms\"\nenergy = \"yes\"",
     "energy =", "output.energy: is a text; true or false is due"},
    {"series = \"0.1 ms\"", "series = \"-0.1 ms\"", "", "output.series: -100 us cannot be"},
    {"voxel = \"17.3 um\"", "voxel = \"0 um\"", "", "fields.layer.voxel: 0 m cannot be"},
    {"every = \"10 ms\"", "every = \"0 ms\"", "", "fields.layer.every"},
    // sizes
    {"min = \"5 um\"", "min = \"0 um\"", "", "particles.feed.diameter.min: 0 m cannot be"},
    {"min = \"5 um\"", "min = \"70 um\"", "", "particles.feed.diameter.max: 65 um is not above min, 70 um"},
    {"max = \"65 um\"", "max = \"30 um\"", "",
     "particles.feed.diameter.mean: 39.4 um is outside the distribution's cut; 5 um to 30 um"},
    {"sd = \"10.5 um\"", "sd = \"-1 um\"", "", "particles.feed.diameter.sd: -1 um cannot be"},
    {"sd = \"10.5 um\", ", "", "diameter = {", "particles.feed.diameter.sd: is missing"},
    {"distribution = \"normal\"", "distribution = \"norml\"", "",
     "\"norml\" is unknown; allowed: single, normal, lognormal, uniform, bimodal, table; did you mean "
     "\"normal\"?"},
    {"distribution = \"normal\", ", "", "diameter = {", "particles.feed.diameter.distribution: is missing"},
    {"max = \"65 um\" }", "max = \"65 um\", weight = \"volume\" }", "weight",
     "\"volume\" is unknown; allowed: number, mass"},
    {"diameter = { distribution = \"normal\", mean = \"39.4 um\", sd = \"10.5 um\", min = \"5 um\", max = "
     "\"65 um\" }",
     "diameter = 40", "", "particles.feed.diameter: 40 has no unit"},
    {"diameter = { distribution = \"normal\", mean = \"39.4 um\", sd = \"10.5 um\", min = \"5 um\", max = "
     "\"65 um\" }",
     "diameter = \"-40 um\"", "", "grains of powder are of finite size"},
    {"diameter = { distribution = \"normal\", mean = \"39.4 um\", sd = \"10.5 um\", min = \"5 um\", max = "
     "\"65 um\" }\n",
     "", "[[particles]]", "particles.feed.diameter: is missing; insert.method = \"rain\" needs it"},
    {"{ distribution = \"normal\", mean = \"39.4 um\", sd = \"10.5 um\", min = \"5 um\", max = \"65 um\" }",
     "{ distribution = \"table\", diameters = [\"5 um\", \"65 um\"], shares = [1, 2] }", "",
     "has 2 edges for 2 shares"},
    {"{ distribution = \"normal\", mean = \"39.4 um\", sd = \"10.5 um\", min = \"5 um\", max = \"65 um\" }",
     "{ distribution = \"table\", diameters = [\"5 um\", \"65 um\", \"60 um\"], shares = [1, 2] }", "",
     "60 um follows 65 um; the edges must rise"},
    {"{ distribution = \"normal\", mean = \"39.4 um\", sd = \"10.5 um\", min = \"5 um\", max = \"65 um\" }",
     "{ distribution = \"table\", diameters = [\"5 um\", \"65 um\"], shares = [0] }", "", "are all zero"},
    {"{ distribution = \"normal\", mean = \"39.4 um\", sd = \"10.5 um\", min = \"5 um\", max = \"65 um\" }",
     "{ distribution = \"bimodal\", mean = \"20 um\", sd = \"2 um\", mean2 = \"80 um\", sd2 = \"2 um\", "
     "share2 = 0.5, min = \"5 um\", max = \"65 um\" }",
     "", "particles.feed.diameter.mean2: 80 um is outside"},
    // insertion
    {"method = \"rain\"", "method = \"hose\"", "", "\"hose\" is unknown; allowed: rain, list"},
    {"count = 1000\n", "", "[[particles]]",
     "particles.feed.count: is missing; insert.method = \"rain\" needs it"},
    {"phase = \"pour\", box", "phase = \"puor\", box", "",
     "particles.feed.insert.phase: \"puor\" is not in [[phases]]; allowed: pour, spread; did you mean "
     "\"pour\"?"},
    {"[\"1.5 mm\", \"2.1 mm\"]", "[\"1.5 mm\", \"9.1 mm\"]", "",
     "particles.feed.insert.box: 1.5 mm to 9.1 mm reaches outside the domain along z"},
    {"[\"1.5 mm\", \"2.1 mm\"]", "[\"1.5 mm\", \"1.51 mm\"]", "",
     "is 10 um along z, and the largest grain 65 um"},
    // boxes
    {"[\"0 mm\", \"3 mm\"]]", "[\"3 mm\", \"0 mm\"]]", "", "domain.box.2: 3 mm to 0 m is empty along z"},
    {"[\"-0.25 mm\", \"0.25 mm\"], ", "[\"-0.25 mm\", \"-0.25 mm\"], ", "",
     "fields.layer.box.1: -250 um to -250 um is empty along y"},
    {"box = [[\"0 mm\", \"2 mm\"], [\"-0.5 mm\", \"0.5 mm\"], [\"0 mm\", \"3 mm\"]]",
     "box = [\"0 mm\", \"2 mm\"]", "", "domain.box: is not a box"},
    {"box = [[\"0 mm\", \"2 mm\"], [\"-0.5 mm\", \"0.5 mm\"], [\"0 mm\", \"3 mm\"]]\n", "", "[domain]",
     "domain.box: is missing"},
    // materials and pairs
    {"name = \"feed\"\nmaterial = \"powder\"", "name = \"feed\"\nmaterial = \"powdr\"",
     "material = \"powdr\"",
     "particles.feed.material: \"powdr\" is not in [materials]; allowed: powder, steel; did you mean "
     "\"powder\"?"},
    {"name = \"blade\"\nmaterial = \"steel\"", "name = \"blade\"\nmaterial = \"brass\"",
     "material = \"brass\"", "walls.blade.material: \"brass\" is not in [materials]"},
    {"wall_material = \"steel\"", "wall_material = \"stel\"", "",
     "domain.wall_material: \"stel\" is not in [materials]"},
    {"wall_material = \"steel\"\n", "", "boundary",
     "domain.boundary: has a wall, and wall_material is missing"},
    {"wall_material = \"steel\"", "wall_material = [\"steel\", \"steel\", \"\"]", "",
     "names a material along x, where no wall is"},
    {"wall_material = \"steel\"", "wall_material = 3", "", "is neither a name nor three"},
    {"boundary = [\"open\", \"wall\", \"open\"]", "boundary = [\"open\", \"open\", \"open\"]",
     "wall_material", "no boundary is a wall"},
    {"boundary = [\"open\", \"wall\", \"open\"]", "boundary = [\"open\", \"wal\", \"open\"]", "boundary",
     "domain.boundary.1: \"wal\" is unknown"},
    {"materials = [\"steel\", \"powder\"]", "materials = [\"steel\", \"steel\"]", "[[contact.pair]]",
     "contact.pair: powder and steel can meet, and the pair is not given; every pair that can meet is due; "
     "add [[contact.pair]] with materials = [\"powder\", \"steel\"]"},
    {"materials = [\"steel\", \"powder\"]",
     "materials = [\"powder\", \"steel\"]\nrestitution = 0.1\nfriction = 0.1\nrolling_friction = "
     "0.1\ncohesion_energy_density = \"1 J/m^3\"\n[[contact.pair]]\nmaterials = [\"steel\", \"powder\"]",
     "[\"steel\", \"powder\"]", "steel and powder are given twice"},
    {"materials = [\"powder\", \"powder\"]",
     "materials = [\"powder\", \"powder\"]\nrestitution = 0\nfriction = 0\nrolling_friction = "
     "0\ncohesion_energy_density = \"0 J/m^3\"\n[[contact.pair]]\nmaterials = [\"powder\", \"glue\"]",
     "glue", "\"glue\" is not in [materials]"},
    // laws
    {"normal = \"hertz\"", "normal = \"hooc\"", "",
     "contact.normal: \"hooc\" is unknown; allowed: hooke, hertz; did you mean \"hooke\"?"},
    {"tangential = \"mindlin\"", "tangential = \"spring\"", "",
     "\"spring\" is unknown; allowed: none, slider, mindlin; choose one of them"},
    {"rolling = \"cdt\"", "rolling = \"epsd\"", "", "allowed: none, cdt, epsd2; did you mean \"epsd2\"?"},
    {"cohesion = \"sjkr\"", "cohesion = \"liquid\"", "",
     "\"liquid\" is unknown; allowed: none, sjkr, jkr, dmt, van_der_waals; choose one of them"},
    {"damping = \"tension\"", "damping = \"clip\"", "",
     "\"clip\" is unknown; allowed: tension, clipped, clipped_uncorrected; did you mean \"clipped\"?"},
    {"friction = 0.3\n", "", "[[contact.pair]]",
     "contact.pair.powder-powder.friction: is missing; contact.tangential = \"mindlin\" needs it for every "
     "pair; add friction = ..., or set contact.tangential = \"none\""},
    {"cohesion_energy_density = \"10 kJ/m^3\"\n", "", "# with the walls",
     "contact.pair.steel-powder.cohesion_energy_density: is missing"},
    // walls
    {"normal = [0, 0, 2]", "normal = [0, 0, 0]", "", "walls.substrate.shape.plane.normal: is zero"},
    {"normal = [0, 0, 2]", "normal = [0, 2]", "", "normal: is not a list of three"},
    {"center = [\"-0.1 mm\", \"0 mm\", \"1.07 mm\"], ", "", "shape = { box",
     "walls.blade.shape.box: is not one box"},
    {"size = [\"0.2 mm\", ", "size = [\"-0.2 mm\", ", "", "walls.blade.shape.box.size.0: -200 um cannot be"},
    {"box = { center = [\"-0.1 mm\", \"0 mm\", \"1.07 mm\"], size = [\"0.2 mm\", \"1.5 mm\", \"2 mm\"] }",
     "box = { lo = [\"0 mm\", \"0 mm\", \"0 mm\"], hi = [\"1 mm\", \"0 mm\", \"1 mm\"] }", "",
     "walls.blade.shape.box.hi: is not above lo along y"},
    {"{ plane = {", "{ plain = {", "", "walls.substrate.shape.plain: unknown key"},
    {"name = \"blade\"", "name = \"substrate\"  # here", "# here", "walls.1.name: \"substrate\" is taken"},
    {"name = \"blade\"", "name = \"the blade\"", "", "\"the blade\" is not a name"},
    {"{ phase = \"spread\", velocity", "{ phase = \"spraed\", velocity", "",
     "walls.blade.motion.0.phase: \"spraed\" is not in [[phases]]"},
    {"motion = [{ phase = \"spread\",",
     "motion = [{ phase = \"spread\", velocity = [\"0 m/s\", \"0 m/s\", \"0 m/s\"] }, { phase = \"spread\",",
     "", "walls.blade.motion.1.phase: \"spread\" is there twice"},
    {"motion = [{ phase = \"spread\", velocity = [\"0.05 m/s\", \"0 m/s\", \"0 m/s\"] }]",
     "motion = { phase = \"spread\" }", "", "walls.blade.motion: is a table; an array of tables is due"},
    // phases
    {"name = \"pour\"", "name = \"spread\"", "name = \"spread\"\nduration", "is taken"},
    {"duration = \"40 ms\"\n", "", "# the last", "phases.spread: has neither duration nor until"},
    {"duration = \"40 ms\"", "duration = \"40 ms\"\nuntil = { settled = true, at_most = \"1 s\" }",
     "# the last", "phases.spread: has both duration and until"},
    {", at_most = \"100 ms\"", "", "until = {", "phases.pour.until.at_most: is missing"},
    {"inserted = true, settled = true, ", "", "until = {", "phases.pour.until: waits for nothing"},
    // fields
    {"[\"0 mm\", \"0.1 mm\"]]", "[\"0 mm\", \"9 mm\"]]", "",
     "fields.layer.box: 0 m to 9 mm reaches outside the domain along z"},
    {"average = \"120 um\"", "average = \"10 um\"", "", "10 um is less than a voxel; at least 17.3 um"},
    {"average = \"120 um\"", "average_window = \"ball\"", "",
     "\"ball\" is unknown; allowed: box, sphere, gaussian; choose one of them"},
    {"\"x=1 mm\"", "\"x=5 mm\"", "",
     "fields.layer.slices.1: x = 5 mm is outside the field's box; 0 m to 2 mm is allowed"},
    {"\"x=1 mm\"", "\"x=5\"", "", "fields.layer.slices.1: 5 has no unit"},
    {"\"y@x=1 mm,z=35 um\"", "\"y@x=1 mm\"", "", "fields.layer.lines.0: \"y@x=1 mm\" cannot be understood"},
    {"\"y@x=1 mm,z=35 um\"", "\"y@x=1 mm,z=1 mm\"", "", "fields.layer.lines.0: z = 1 mm is outside"},
    {"z = [\"0 um\", \"70 um\"]", "z = [\"70 um\", \"0 um\"]", "",
     "fields.layer.layers.z: 70 um to 0 m is empty"},
    {"z = [\"0 um\", \"70 um\"]", "z = [\"0 um\", \"170 um\"]", "",
     "fields.layer.layers.z: reaches outside the field's box"},
    {"columns = [20, 5]", "columns = [20, 0]", "", "is not two counts; [NX, NY], each 1 to 100000"},
    {"voxel = \"17.3 um\"", "voxel = \"1e-6 nm\"", "", "voxels along"},
    // syntax
    {"seed = 7", "seed = ", "", "not valid TOML"},
    {"[output]", "[output", "", "not valid TOML"},
    {"title = \"Example\"", "title = \"Example", "", "not valid TOML"},
    {"seed = 7", "seed = 7\nseed = 8", "seed = 8", "not valid TOML"},
};

std::vector<std::string> errors_of(const std::string& text) {
  try {
    read_scene_text(text, "x.toml");
  } catch (const InputError& error) {
    return error.messages();
  }
  return {};
}

TEST(SceneErrors, EachByOneChangeAndOnItsLine) {
  for (const Change& change : kChanges) {
    const std::string text = replaced(kExampleScene, change.from, change.to);
    ASSERT_FALSE(text.empty()) << "not once in the example: " << change.from;
    const auto errors = errors_of(text);
    ASSERT_FALSE(errors.empty()) << "accepted: " << change.from << " -> " << change.to;
    std::string all;
    bool found = false;
    for (const std::string& message : errors) {
      all += message + "\n";
      if (message.find(change.fragment) == std::string::npos) continue;
      found = true;
      const std::string place =
          fmt::format("x.toml:{}:", line_of(text, change.line.empty() ? change.to : change.line));
      EXPECT_EQ(message.rfind(place, 0), 0u) << "expected at " << place << " but is\n" << message;
    }
    EXPECT_TRUE(found) << "expected: " << change.fragment << "\ngot:\n" << all;
    // a misspelt key is also a missing one; nothing else may follow from one mistake
    EXPECT_LE(errors.size(), 2u) << change.to << "\n" << all;
  }
}

TEST(SceneErrors, TheExampleItselfIsGood) { EXPECT_EQ(errors_of(kExampleScene), std::vector<std::string>{}); }

TEST(SceneErrors, AllAreReportedTogetherInTheOrderOfTheFile) {
  std::string text = replaced(kExampleScene, "seed = 7", "seed = \"x\"");
  text = replaced(text, "poisson_ratio = 0.3\n", "poisson_ratio = 3\n");
  text = replaced(text, "voxel = \"17.3 um\"", "voxel = 17.3");
  text = replaced(text, "title =", "titl =");
  const auto errors = errors_of(text);
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_NE(errors[0].find("titl: unknown key"), std::string::npos);
  EXPECT_NE(errors[1].find("poisson_ratio"), std::string::npos);
  EXPECT_NE(errors[2].find("time.seed"), std::string::npos);
  EXPECT_NE(errors[3].find("fields.layer.voxel"), std::string::npos);
}

TEST(SceneErrors, AKeyOfALawThatIsNotNamed) {
  struct Row {
    std::string law, none, fragment;
  };
  for (const Row& row : {Row{"cohesion = \"sjkr\"", "cohesion = \"none\"",
                             "cohesion_energy_density: is given although contact.cohesion is \"none\"; it is "
                             "allowed with contact.cohesion = \"sjkr\"; name that law or drop this key"},
                         Row{"tangential = \"mindlin\"", "tangential = \"none\"",
                             ".friction: is given although contact.tangential"},
                         Row{"rolling = \"cdt\"", "rolling = \"none\"",
                             "rolling_friction: is given although contact.rolling"}}) {
    const auto errors = errors_of(replaced(kExampleScene, row.law, row.none));
    ASSERT_EQ(errors.size(), 2u) << row.none;  // one a pair
    EXPECT_NE(errors[0].find(row.fragment), std::string::npos) << errors[0];
  }
}

TEST(SceneErrors, PeriodicAxes) {
  const std::string periodic =
      replaced(replaced(kExampleScene, "\"open\", \"wall\", \"open\"]", "\"open\", \"wall\", \"periodic\"]"),
               "[\"0 mm\", \"3 mm\"]]", "[\"0 mm\", \"3 mm\"]]");
  auto errors = errors_of(periodic);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("walls.substrate.shape: the plane's normal has a part along z, which is periodic"),
            std::string::npos);
  const std::string narrow =
      replaced(replaced(kExampleScene, "\"open\", \"wall\", \"open\"]\nwall_material = \"steel\"",
                        "\"open\", \"periodic\", \"open\"]"),
               "[\"-0.5 mm\", \"0.5 mm\"]", "[\"-0.06 mm\", \"0.06 mm\"]");
  bool found = false;
  for (const std::string& message : errors_of(narrow))
    found = found ||
            message.find(
                "domain.box: is 120 um along y, which is periodic, and the largest grain of feed is 65 um") !=
                std::string::npos;
  EXPECT_TRUE(found);
}

TEST(SceneErrors, NoPhasesNoDomainNothing) {
  const auto errors = errors_of("");
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_EQ(errors[0], "x.toml:1:1: domain: is missing; it has no default; add domain = { ... }");
  EXPECT_EQ(errors[1], "x.toml:1:1: phases: is missing; it has no default; add [[phases]]");
  EXPECT_NE(
      errors_of("domain = {box=[[\"0 m\",\"1 m\"],[\"0 m\",\"1 m\"],[\"0 m\",\"1 m\"]]}\nphases = []")[0]
          .find("phases: is empty"),
      std::string::npos);
}

TEST(SceneErrors, ATableHeaderWithoutAName) {  // toml++ 3.3 asserts on these
  for (const std::string header : {"[,]", "[=]", "[[,]]", "[ [a] ]", "[]", "[[]]", "[.a]", "[a.]", "[\"]"}) {
    const std::string text = replaced(kExampleScene, "[output]", header);
    const auto errors = errors_of(text);
    ASSERT_EQ(errors.size(), 1u) << header;
    EXPECT_EQ(errors[0].rfind(fmt::format("x.toml:{}:", line_of(text, "trajectory") - 1), 0), 0u)
        << errors[0];
  }
}

TEST(SceneErrors, LettersBeyondAsciiOutsideQuotes) {
  for (const std::string letter :
       {"\xC2\xB5", "\xC3\xA9", "\xE2\x80\x8B", "\xE2\x82\xAC", "\xEF\xBB\xBF", "\xF0\x9F\x98\x80"}) {
    for (const std::string from : {"seed = 7", "seed", "= 7", "[time]"}) {
      const auto errors = errors_of(replaced(kExampleScene, from, from + letter));
      ASSERT_EQ(errors.size(), 1u) << from << letter;
      EXPECT_NE(errors[0].find("not valid TOML"), std::string::npos) << errors[0];
    }
    EXPECT_TRUE(
        errors_of(replaced(kExampleScene, "\"Example\"", "\"\"\"\\\n  " + letter + "\"\"\"")).empty());
  }
}

TEST(SceneErrors, FilesThatCannotBeRead) {
  for (const std::string& path : {std::string("/no/such/scene.toml"), std::string("/")}) {
    try {
      read_scene(path);
      FAIL();
    } catch (const InputError& error) {
      ASSERT_EQ(error.messages().size(), 1u);
      EXPECT_EQ(error.messages()[0].rfind(path + ": cannot be read: ", 0), 0u) << error.what();
    }
  }
}

TEST(SceneWarnings, ImplausibleValuesAreWarnedOf) {
  struct Row {
    std::string from, to, fragment;
  };
  const Row rows[] = {
      {"density = \"8200 kg/m^3\"\nyoungs_modulus = \"1 GPa\"",
       "density = \"8200 kg/m^3\"\nyoungs_modulus = \"1e20 Pa\"",
       "materials.powder.youngs_modulus: 1e+20 Pa is far from"},
      {"density = \"8200 kg/m^3\"\nyoungs_modulus = \"1 GPa\"",
       "density = \"8200 kg/m^3\"\nyoungs_modulus = \"1 Pa\"", "youngs_modulus: 1 Pa is far from"},
      {"density = \"8200 kg/m^3\"", "density = \"8200 g/cm^3\"", "density: 8200000 kg/m^3 is far from"},
      {"min = \"5 um\"", "min = \"5 nm\"", "diameter.min: 5 nm is far from"},
      {"step = { rayleigh = 0.2, collision = 0.04 }", "step = \"1 us\"", "time.step: 1 us is"},
      {"collision = 0.04", "collision = 0.1", "time.step.collision: 0.1 is far from"},
      {"\"-9.81 m/s^2\"", "\"-9.81 km/ms^2\"", "domain.gravity.2"},
  };
  for (const Row& row : rows) {
    std::vector<std::string> warnings;
    read_scene_text(replaced(kExampleScene, row.from, row.to), "x.toml", {}, &warnings);
    ASSERT_EQ(warnings.size(), 1u) << row.to;
    EXPECT_NE(warnings[0].find(row.fragment), std::string::npos) << warnings[0];
    EXPECT_EQ(warnings[0].rfind("x.toml:", 0), 0u) << warnings[0];
  }
  std::vector<std::string> none;
  read_scene_text(kExampleScene, "x.toml", {}, &none);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace interstice::scene
