// The laws of contact, and what each pair of materials has to say for them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/scene/format_quantity.h"
#include "coupling/scene/readers.h"

namespace interstice::scene {
namespace {

/// The words of [contact], by key; empty where one was wrong, so that nothing follows from it.
using LawWords = std::map<std::string, std::string, std::less<>>;

/// Do the laws in force use a key? A wrong word leaves it open.
struct Use {
  enum { yes, no, open } answer = yes;
  std::string law, word;           // the key of [contact] that decides, and what it says
  std::vector<std::string> words;  // what it would have to say
};

Use use_of(const Key& key, const LawWords& laws) {
  Use use;
  if (key.law.empty()) return use;
  use.words = split_words(key.law);
  use.law = use.words.front();
  use.words.erase(use.words.begin());
  const Use outer = use_of(*section("contact").find(use.law), laws);
  if (outer.answer != Use::yes) return outer;
  use.word = laws.at(use.law);
  const bool named = std::find(use.words.begin(), use.words.end(), use.word) != use.words.end();
  use.answer = use.word.empty() ? Use::open : named ? Use::yes : Use::no;
  return use;
}

/// Reports a key that is given although no law uses it, and one that is due and not given. Returns whether
/// there is something to read.
bool check_use(const TableReader& table, const Section& section, std::string_view name,
               const LawWords& laws) {
  const Key& key = *section.find(name);
  const Use use = use_of(key, laws);
  if (use.answer == Use::no && table.has(name))
    table.error(
        name, fmt::format("is given although contact.{} is \"{}\"", use.law, use.word),
        fmt::format("it is allowed with contact.{} = \"{}\"", use.law, fmt::join(use.words, "\" or \"")),
        "name that law or drop this key");
  if (use.answer == Use::yes && key.due && !table.has(name)) {
    const auto others = split_words(scene::section("contact").find(use.law)->words);
    const bool none = others.front() == "none";
    table.error(name, "is missing",
                fmt::format("contact.{} = \"{}\" needs it{}", use.law, use.word,
                            section.name == "contact.pair" ? " for every pair" : ""),
                fmt::format("add {} = ..., or {} contact.{}{}", name, none ? "set" : "choose another",
                            use.law, none ? " = \"none\"" : ""));
  }
  return use.answer != Use::no && (table.has(name) || (use.answer == Use::yes && !key.fallback.empty()));
}

/// A table's quantities that only some laws use: zero where they are not in force.
struct LawReader {
  const TableReader& table;
  const Section& section;
  const LawWords& laws;

  double operator()(std::string_view name) const {
    return check_use(table, section, name, laws) ? table.quantity(name) : 0;
  }
};

/// The place of a word among those of its key, which is that of its enumerator.
template <class Law>
Law law_of(const LawWords& laws, std::string_view key) {
  const auto words = split_words(section("contact").find(key)->words);
  const auto found = std::find(words.begin(), words.end(), laws.find(key)->second);
  return found == words.end() ? Law{} : static_cast<Law>(found - words.begin());
}

/// The work of adhesion w, given as such or by the energy gamma of each of the two surfaces: w = 2 gamma.
double read_adhesion(const LawReader& read) {
  const double work = read("work_of_adhesion"), surface = read("surface_energy");
  const std::string& law = read.laws.at("cohesion");
  if (law != "jkr" && law != "dmt") return work;
  const bool has_work = read.table.has("work_of_adhesion"), has_surface = read.table.has("surface_energy");
  if (has_work && has_surface)
    read.table.error("surface_energy", "is given beside work_of_adhesion",
                     "one of the two is due: work_of_adhesion w, or surface_energy gamma, and w = 2 gamma",
                     "drop one");
  if (!has_work && !has_surface)
    read.table.error("work_of_adhesion", "is missing, and so is surface_energy",
                     fmt::format("contact.cohesion = \"{}\" needs one of them for every pair: "
                                 "work_of_adhesion w, or surface_energy gamma, and w = 2 gamma",
                                 law),
                     "add work_of_adhesion = \"0.2 mJ/m^2\" or surface_energy = \"0.1 mJ/m^2\"");
  return has_surface ? 2 * surface : work;
}

void read_van_der_waals(const LawReader& read, ContactPair& pair) {
  pair.hamaker_constant = read("hamaker_constant");
  pair.cutoff = read("cutoff");
  pair.range = read("range");
  if (!read.table.has("range")) pair.range = 100 * pair.cutoff;
  if (read.table.has("cutoff") && pair.range <= pair.cutoff && pair.cutoff > 0)
    read.table.error(
        "range",
        fmt::format("{} is not above cutoff, {}", format_length(pair.range), format_length(pair.cutoff)),
        "the force is constant up to the one and ends at the other",
        "make it larger, or drop it: then it is 100 times the cutoff");
}

/// Below this restitution a clipped dashpot loses no more: the pair creeps apart.
constexpr double kLeastClipped = 0.03;

ContactPair read_pair(const TableReader& table, const LawWords& laws) {
  ContactPair pair;
  const auto names = table.texts("materials");
  if (names.size() == 2)
    pair.materials = {names[0], names[1]};
  else if (table.has("materials"))
    table.error("materials", fmt::format("has {} names", names.size()), "two materials meet in a contact",
                "write for instance materials = [\"powder\", \"steel\"]");
  pair.restitution = table.quantity("restitution");
  if (laws.at("damping") == "clipped" && pair.restitution < kLeastClipped)
    table.problems().warn(
        table.place("restitution"), table.path("restitution"),
        fmt::format("{} with contact.damping = \"clipped\" comes out as {}, strongly overdamped below",
                    pair.restitution, kLeastClipped),
        fmt::format("take {} or more, or damping = \"tension\"", kLeastClipped));
  const LawReader read{table, section("contact.pair"), laws};
  pair.stiffness = read("stiffness");
  pair.friction = read("friction");
  pair.rolling_friction = read("rolling_friction");
  pair.cohesion_energy_density = read("cohesion_energy_density");
  pair.work_of_adhesion = read_adhesion(read);
  read_van_der_waals(read, pair);
  return pair;
}

LawWords read_words(const TableReader& table) {
  LawWords laws;
  for (const char* key : {"normal", "damping", "tangential", "rolling", "cohesion"})
    laws[key] = table.choice(key);
  laws["stiffness_rule"] = "given";  // says nothing without hooke
  if (check_use(table, section("contact"), "stiffness_rule", laws))
    laws["stiffness_rule"] = table.choice("stiffness_rule");
  if (laws["normal"] == "hooke" && laws["cohesion"] == "jkr")
    table.error("cohesion", "\"jkr\" does not go with contact.normal = \"hooke\"",
                "jkr has an elastic law of its own, which is hertz's as adhesion vanishes",
                "set contact.normal = \"hertz\", or choose another cohesion");
  return laws;
}

}  // namespace

Contact read_contact(const Value* value, const Place& around, Problems& problems) {
  const TableReader table(value, section("contact"), "contact", around, problems);
  Contact contact;
  if (!table) return contact;
  const LawWords laws = read_words(table);
  contact.normal = law_of<NormalLaw>(laws, "normal");
  if (contact.normal == NormalLaw::hooke)
    contact.stiffness_rule = law_of<StiffnessRule>(laws, "stiffness_rule");
  contact.damping = law_of<Damping>(laws, "damping");
  contact.tangential = law_of<TangentialLaw>(laws, "tangential");
  contact.rolling = law_of<RollingLaw>(laws, "rolling");
  contact.cohesion = law_of<CohesionLaw>(laws, "cohesion");
  const LawReader read{table, section("contact"), laws};
  contact.design_speed = read("design_speed");
  contact.overlap_limit = read("overlap_limit");
  contact.slider_velocity = read("slider_velocity");
  const auto pairs = table.tables("pair");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const TableReader pair(pairs[i], section("contact.pair"), table.element_path("pair", i), table.place(),
                           problems);
    contact.pairs.push_back(pair ? read_pair(pair, laws) : ContactPair{});
  }
  return contact;
}

}  // namespace interstice::scene
