// Every combination of contact laws, what each asks of a pair, and what is said where that is not met.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "coupling/scene/read_scene.h"
#include "coupling/scene/schema.h"
#include "coupling/scene/write_scene.h"
#include "tests/coupling/scene/example_scene.h"

namespace interstice::scene {
namespace {

using Words = std::vector<std::string>;

Contact contact_of(const std::string& laws, const std::string& parameters, Words* warnings = nullptr) {
  return read_scene_text(with_contact(laws, parameters), "x.toml", {}, warnings).contact;
}

/// The messages about good laws or parameters with one fault.
Words errors_of(const std::string& laws, const std::string& parameters) {
  try {
    contact_of(laws, parameters);
  } catch (const InputError& error) {
    return error.messages();
  }
  return {};
}

/// A choice of laws, what they add to [contact] and to a pair, and what must come of it.
struct Case {
  std::string laws, parameters;
  Contact contact;
  ContactPair pair;

  Case() { parameters = "restitution = 0.35\n", pair.restitution = 0.35; }
};

void add_normal(Case& c, const std::string& word) {
  const bool hooke = word != "hertz";
  c.laws += hooke ? "normal = \"hooke\"\nstiffness_rule = \"" + word + "\"\n" : "normal = \"hertz\"\n";
  c.contact.normal = hooke ? NormalLaw::hooke : NormalLaw::hertz;
  if (word == "given") c.parameters += "stiffness = \"12.3 kN/m\"\n", c.pair.stiffness = 12300;
  if (word == "overlap" || word == "velocity")
    c.laws += "design_speed = \"0.3 m/s\"\n", c.contact.design_speed = 0.3;
  if (word == "overlap") c.laws += "overlap_limit = \"0.7 %\"\n", c.contact.overlap_limit = 0.007;
  c.contact.stiffness_rule = word == "overlap"    ? StiffnessRule::overlap
                             : word == "velocity" ? StiffnessRule::velocity
                                                  : StiffnessRule::given;
}

void add_friction(Case& c, const std::string& tangential, const std::string& rolling) {
  c.laws += fmt::format("tangential = \"{}\"\nrolling = \"{}\"\n", tangential, rolling);
  if (tangential == "slider") c.contact.slider_velocity = 1e-3;
  c.contact.tangential = tangential == "slider"    ? TangentialLaw::slider
                         : tangential == "mindlin" ? TangentialLaw::mindlin
                                                   : TangentialLaw::none;
  c.contact.rolling = rolling == "cdt"     ? RollingLaw::cdt
                      : rolling == "epsd2" ? RollingLaw::epsd2
                                           : RollingLaw::none;
  if (tangential != "none") c.parameters += "friction = 0.3\n", c.pair.friction = 0.3;
  if (rolling != "none") c.parameters += "rolling_friction = 0.01\n", c.pair.rolling_friction = 0.01;
}

void add_damping_and_cohesion(Case& c, const std::string& damping, const std::string& cohesion) {
  c.laws += fmt::format("damping = \"{}\"\ncohesion = \"{}\"\n", damping, cohesion);
  c.contact.damping = damping == "clipped"               ? Damping::clipped
                      : damping == "clipped_uncorrected" ? Damping::clipped_uncorrected
                                                         : Damping::tension;
  if (cohesion == "sjkr") {
    c.contact.cohesion = CohesionLaw::sjkr;
    c.parameters += "cohesion_energy_density = \"1 MJ/m^3\"\n", c.pair.cohesion_energy_density = 1e6;
  } else if (cohesion == "jkr") {
    c.contact.cohesion = CohesionLaw::jkr;
    c.parameters += "surface_energy = \"0.1 mJ/m^2\"\n", c.pair.work_of_adhesion = 2e-4;
  } else if (cohesion == "dmt") {
    c.contact.cohesion = CohesionLaw::dmt;
    c.parameters += "work_of_adhesion = \"0.3 mJ/m^2\"\n", c.pair.work_of_adhesion = 3e-4;
  } else if (cohesion == "van_der_waals") {
    c.contact.cohesion = CohesionLaw::van_der_waals;
    c.parameters += "hamaker_constant = \"65 zJ\"\ncutoff = \"0.165 nm\"\n";
    c.pair.hamaker_constant = 65e-21, c.pair.cutoff = 0.165e-9, c.pair.range = 100 * 0.165e-9;
  }
}

Words words_of(std::string_view key) { return split_words(section("contact").find(key)->words); }

TEST(ContactLaws, EveryCombinationIsReadAndResolves) {
  int combinations = 0;
  for (const std::string normal : {"hertz", "given", "overlap", "velocity"})
    for (const std::string& damping : words_of("damping"))
      for (const std::string& tangential : words_of("tangential"))
        for (const std::string& rolling : words_of("rolling"))
          for (const std::string& cohesion : words_of("cohesion")) {
            if (normal != "hertz" && cohesion == "jkr") continue;
            Case c;
            add_normal(c, normal);
            add_friction(c, tangential, rolling);
            add_damping_and_cohesion(c, damping, cohesion);
            c.contact.pairs = {c.pair, c.pair};
            c.contact.pairs[0].materials = {"powder", "powder"};
            c.contact.pairs[1].materials = {"steel", "powder"};
            Words warnings;
            Scene scene = read_scene_text(with_contact(c.laws, c.parameters), "x.toml", {}, &warnings);
            ASSERT_TRUE(scene.contact == c.contact) << c.laws << c.parameters << resolved_toml(scene);
            ASSERT_TRUE(warnings.empty()) << warnings.front();
            const std::string text = resolved_toml(scene);
            ASSERT_TRUE(read_scene_text(text, "x.toml") == scene) << text;
            ++combinations;
          }
  EXPECT_EQ(combinations, 4 * 3 * 3 * 3 * 5 - 3 * 3 * 3 * 3);
}

TEST(ContactLaws, WordsStandInTheOrderOfTheirEnumerators) {
  EXPECT_EQ(words_of("normal").at(static_cast<std::size_t>(NormalLaw::hertz)), "hertz");
  EXPECT_EQ(words_of("stiffness_rule").at(static_cast<std::size_t>(StiffnessRule::velocity)), "velocity");
  EXPECT_EQ(words_of("damping").at(static_cast<std::size_t>(Damping::clipped_uncorrected)),
            "clipped_uncorrected");
  EXPECT_EQ(words_of("tangential").at(static_cast<std::size_t>(TangentialLaw::mindlin)), "mindlin");
  EXPECT_EQ(words_of("rolling").at(static_cast<std::size_t>(RollingLaw::epsd2)), "epsd2");
  EXPECT_EQ(words_of("cohesion").at(static_cast<std::size_t>(CohesionLaw::van_der_waals)), "van_der_waals");
}

// w = 2 gamma: two surfaces vanish where two grains of one solid touch.
TEST(ContactLaws, AdhesionByEitherConventionIsTheSame) {
  for (const std::string law : {"cohesion = \"jkr\"", "cohesion = \"dmt\""}) {
    const std::string e = "restitution = 0.5\n";
    EXPECT_EQ(contact_of(law, e + "work_of_adhesion = \"0.2 mJ/m^2\""),
              contact_of(law, e + "surface_energy = \"0.1 mJ/m^2\""));
    EXPECT_EQ(contact_of(law, e + "surface_energy = \"0.07 N/m\"").pairs[0].work_of_adhesion, 0.14);
  }
}

TEST(ContactLaws, OptionalParametersHaveDefaultsAndCanBeGiven) {
  const std::string van_der_waals = "cohesion = \"van_der_waals\"";
  const std::string pair = "restitution = 0.5\nhamaker_constant = \"0.4 eV\"\ncutoff = \"0.2 nm\"\n";
  EXPECT_EQ(contact_of(van_der_waals, pair).pairs[0].range, 100 * 0.2e-9);
  EXPECT_EQ(contact_of(van_der_waals, pair + "range = \"0.3 nm\"").pairs[1].range, 0.3e-9);
  EXPECT_NEAR(contact_of(van_der_waals, pair).pairs[0].hamaker_constant, 6.4087e-20, 1e-24);
  const std::string sliding = "restitution = 0.5\nfriction = 0.3";
  EXPECT_EQ(contact_of("tangential = \"slider\"", sliding).slider_velocity, 1e-3);
  EXPECT_EQ(contact_of("tangential = \"slider\"\nslider_velocity = \"5 um/s\"", sliding).slider_velocity,
            5e-6);
  EXPECT_EQ(contact_of("normal = \"hooke\"", "restitution = 0.5\nstiffness = \"1 N/m\"").stiffness_rule,
            StiffnessRule::given);
}

struct Fault {
  std::string laws, parameters;
  std::size_t count;     // of messages: two where it is a parameter of the two pairs
  std::string expected;  // the first message, from its key on
};

const std::string kHooke = "normal = \"hooke\"\n", kE = "restitution = 0.5\n";
const std::string kOverlap = kHooke + "stiffness_rule = \"overlap\"\n";
const std::string kVelocity = kHooke + "stiffness_rule = \"velocity\"\n";
const std::string kVanDerWaals = "cohesion = \"van_der_waals\"";

void expect_faults(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    const Words errors = errors_of(fault.laws, fault.parameters);
    ASSERT_EQ(errors.size(), fault.count)
        << fault.laws << fault.parameters << fmt::format("{}", errors.size());
    const std::string& first = errors.front();
    EXPECT_EQ(first.substr(first.find(": ") + 2), fault.expected);
  }
}

TEST(ContactLaws, FaultsOfTheNormalForceAreNamed) {
  expect_faults({
      {"stiffness_rule = \"given\"", kE, 1,
       "contact.stiffness_rule: is given although contact.normal is \"hertz\"; it is allowed with "
       "contact.normal = \"hooke\"; name that law or drop this key"},
      {"", kE + "stiffness = \"1 N/m\"", 2,
       "contact.pair.powder-powder.stiffness: is given although contact.normal is \"hertz\"; it is allowed "
       "with contact.normal = \"hooke\"; name that law or drop this key"},
      {kHooke, kE, 2,
       "contact.pair.powder-powder.stiffness: is missing; contact.stiffness_rule = \"given\" needs it for "
       "every pair; add stiffness = ..., or choose another contact.stiffness_rule"},
      {kVelocity + "design_speed = \"1 m/s\"", kE + "stiffness = \"1 N/m\"", 2,
       "contact.pair.powder-powder.stiffness: is given although contact.stiffness_rule is \"velocity\"; it "
       "is "
       "allowed with contact.stiffness_rule = \"given\"; name that law or drop this key"},
      {kHooke, kE + "stiffness = \"0 N/m\"", 2,
       "contact.pair.powder-powder.stiffness: 0 N/m cannot be: a contact needs a stiffness; allowed: greater "
       "than 0 N/m; correct the number or its unit"},
      {kHooke, kE + "stiffness = 1000", 2,
       "contact.pair.powder-powder.stiffness: 1000 has no unit; a stiffness is due (SI: N/m); write \"1000 "
       "N/m\" if it is in SI, or for instance \"1 kN/m\""},
      {"design_speed = \"1 m/s\"", kE, 1,
       "contact.design_speed: is given although contact.normal is \"hertz\"; it is allowed with "
       "contact.normal = \"hooke\"; name that law or drop this key"},
      {kHooke + "design_speed = \"1 m/s\"", kE + "stiffness = \"1 N/m\"", 1,
       "contact.design_speed: is given although contact.stiffness_rule is \"given\"; it is allowed with "
       "contact.stiffness_rule = \"overlap\" or \"velocity\"; name that law or drop this key"},
      {kVelocity, kE, 1,
       "contact.design_speed: is missing; contact.stiffness_rule = \"velocity\" needs it; add design_speed = "
       "..., or choose another contact.stiffness_rule"},
      {kOverlap + "design_speed = \"0 m/s\"\noverlap_limit = 0.01", kE, 1,
       "contact.design_speed: 0 m/s cannot be: a stiffness follows from it; allowed: greater than 0 m/s; "
       "correct the number or its unit"},
      {kOverlap + "design_speed = \"1 m/s\"", kE, 1,
       "contact.overlap_limit: is missing; contact.stiffness_rule = \"overlap\" needs it; add overlap_limit "
       "= "
       "..., or choose another contact.stiffness_rule"},
      {kOverlap + "design_speed = \"1 m/s\"\noverlap_limit = 0.51", kE, 1,
       "contact.overlap_limit: 0.51 cannot be: a grain cannot be pressed in farther; allowed: greater than 0 "
       "and at most 0.5; correct the number"},
      {kVelocity + "design_speed = \"1 m/s\"\noverlap_limit = 0.01", kE, 1,
       "contact.overlap_limit: is given although contact.stiffness_rule is \"velocity\"; it is allowed with "
       "contact.stiffness_rule = \"overlap\"; name that law or drop this key"},
      {kHooke + "stiffness_rule = \"overlp\"", kE, 1,
       "contact.stiffness_rule: \"overlp\" is unknown; allowed: given, overlap, velocity; did you mean "
       "\"overlap\"?"},
      {"normal = \"hooc\"\nstiffness_rule = \"velocity\"", kE, 1,
       "contact.normal: \"hooc\" is unknown; allowed: hooke, hertz; did you mean \"hooke\"?"},
  });
}

TEST(ContactLaws, FaultsOfFrictionAreNamed) {
  expect_faults({
      {"tangential = \"mindlin\"\nslider_velocity = \"1 mm/s\"", kE + "friction = 0.3", 1,
       "contact.slider_velocity: is given although contact.tangential is \"mindlin\"; it is allowed with "
       "contact.tangential = \"slider\"; name that law or drop this key"},
      {"tangential = \"slider\"\nslider_velocity = \"0 mm/s\"", kE + "friction = 0.3", 1,
       "contact.slider_velocity: 0 m/s cannot be: friction would jump where the slip turns; allowed: greater "
       "than 0 m/s; correct the number or its unit"},
      {"tangential = \"slider\"", kE, 2,
       "contact.pair.powder-powder.friction: is missing; contact.tangential = \"slider\" needs it for every "
       "pair; add friction = ..., or set contact.tangential = \"none\""},
      {"", kE + "friction = 0.3", 2,
       "contact.pair.powder-powder.friction: is given although contact.tangential is \"none\"; it is allowed "
       "with contact.tangential = \"slider\" or \"mindlin\"; name that law or drop this key"},
      {"rolling = \"epsd2\"", kE, 2,
       "contact.pair.powder-powder.rolling_friction: is missing; contact.rolling = \"epsd2\" needs it for "
       "every pair; add rolling_friction = ..., or set contact.rolling = \"none\""},
  });
}

TEST(ContactLaws, FaultsOfCohesionAreNamed) {
  const std::string pair = kE + "hamaker_constant = \"65 zJ\"\ncutoff = \"0.2 nm\"\n";
  expect_faults({
      {"normal = \"hooke\"\ncohesion = \"jkr\"", kE + "stiffness = \"1 N/m\"\nsurface_energy = \"1 mJ/m^2\"",
       1,
       "contact.cohesion: \"jkr\" does not go with contact.normal = \"hooke\"; jkr has an elastic law of its "
       "own, which is hertz's as adhesion vanishes; set contact.normal = \"hertz\", or choose another "
       "cohesion"},
      {"cohesion = \"dmt\"", kE, 2,
       "contact.pair.powder-powder.work_of_adhesion: is missing, and so is surface_energy; contact.cohesion "
       "= "
       "\"dmt\" needs one of them for every pair: work_of_adhesion w, or surface_energy gamma, and w = 2 "
       "gamma; add work_of_adhesion = \"0.2 mJ/m^2\" or surface_energy = \"0.1 mJ/m^2\""},
      {"cohesion = \"jkr\"", kE + "work_of_adhesion = \"2 J/m^2\"\nsurface_energy = \"1 J/m^2\"", 2,
       "contact.pair.powder-powder.surface_energy: is given beside work_of_adhesion; one of the two is due: "
       "work_of_adhesion w, or surface_energy gamma, and w = 2 gamma; drop one"},
      {"cohesion = \"jkr\"", kE + "work_of_adhesion = \"-2 J/m^2\"", 2,
       "contact.pair.powder-powder.work_of_adhesion: -2 J/m^2 cannot be: adhesion attracts, and no bond is "
       "stronger; allowed: 0 J/m^2 to 1 MJ/m^2; correct the number or its unit"},
      {"cohesion = \"sjkr\"", kE + "cohesion_energy_density = \"1 J/m^3\"\nsurface_energy = \"1 J/m^2\"", 2,
       "contact.pair.powder-powder.surface_energy: is given although contact.cohesion is \"sjkr\"; it is "
       "allowed with contact.cohesion = \"jkr\" or \"dmt\"; name that law or drop this key"},
      {"cohesion = \"dmt\"", kE + "work_of_adhesion = \"1 J/m^2\"\ncohesion_energy_density = \"1 J/m^3\"", 2,
       "contact.pair.powder-powder.cohesion_energy_density: is given although contact.cohesion is \"dmt\"; "
       "it "
       "is allowed with contact.cohesion = \"sjkr\"; name that law or drop this key"},
      {kVanDerWaals, kE + "cutoff = \"0.2 nm\"", 2,
       "contact.pair.powder-powder.hamaker_constant: is missing; contact.cohesion = \"van_der_waals\" needs "
       "it for every pair; add hamaker_constant = ..., or set contact.cohesion = \"none\""},
      {kVanDerWaals, kE + "hamaker_constant = \"65 zJ\"\ncutoff = \"0 nm\"", 2,
       "contact.pair.powder-powder.cutoff: 0 m cannot be: the force would have no end, or reach too far; "
       "allowed: greater than 0 m and at most 10 mm; correct the number or its unit"},
      {kVanDerWaals, pair + "range = \"0.2 nm\"", 2,
       "contact.pair.powder-powder.range: 200 pm is not above cutoff, 200 pm; the force is constant up to "
       "the "
       "one and ends at the other; make it larger, or drop it: then it is 100 times the cutoff"},
      {"cohesion = \"none\"", kE + "range = \"1 nm\"", 2,
       "contact.pair.powder-powder.range: is given although contact.cohesion is \"none\"; it is allowed with "
       "contact.cohesion = \"van_der_waals\"; name that law or drop this key"},
  });
}

TEST(ContactLaws, ImplausibleParametersAreWarnedOf) {
  struct Row {
    std::string laws, parameters, fragment;
  };
  for (const Row& row : {
           Row{kHooke, kE + "stiffness = \"1 uN/m\"", "stiffness: 1 uN/m is far from"},
           Row{"cohesion = \"jkr\"", kE + "work_of_adhesion = \"100 J/m^2\"",
               "work_of_adhesion: 100 J/m^2 is far from what one would expect (0 J/m^2 to 10 J/m^2)"},
           Row{kVanDerWaals, kE + "hamaker_constant = \"65 pJ\"\ncutoff = \"0.2 nm\"",
               "hamaker_constant: 65 pJ is far from"},
           Row{kVanDerWaals, kE + "hamaker_constant = \"65 zJ\"\ncutoff = \"0.165 um\"",
               "cutoff: 165 nm is far from what one would expect (50 pm to 100 nm)"},
           Row{"damping = \"clipped\"", "restitution = 0.01",
               "restitution: 0.01 with contact.damping = \"clipped\" comes out as 0.03, strongly overdamped "
               "below; take 0.03 or more, or damping = \"tension\""},
       }) {
    Words warnings;
    contact_of(row.laws, row.parameters, &warnings);
    ASSERT_EQ(warnings.size(), 2u) << row.parameters;  // one a pair
    EXPECT_NE(warnings[0].find("contact.pair.powder-powder." + row.fragment), std::string::npos)
        << warnings[0];
  }
  for (const std::string damping : {"tension", "clipped_uncorrected"}) {
    Words warnings;
    contact_of("damping = \"" + damping + "\"", "restitution = 0.01", &warnings);
    EXPECT_TRUE(warnings.empty());
  }
}

}  // namespace
}  // namespace interstice::scene
