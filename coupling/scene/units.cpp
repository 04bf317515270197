#include "coupling/scene/units.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace interstice::scene {
namespace {

/// Powers of kilogram, metre, second and radian. The radian counts as a base unit here, so that "Hz" cannot
/// pass for an angular velocity.
using Powers = std::array<int, 4>;

struct DimensionRow {
  Powers powers;
  DimensionInfo info;
};

const DimensionRow& row(Dimension dimension) {
  static const std::array<DimensionRow, 18> rows{{
      {{0, 0, 0, 0}, {"a number without a unit", "", "0.3"}},
      {{0, 1, 0, 0}, {"a length", "m", "40 um"}},
      {{0, 2, 0, 0}, {"an area", "m^2", "1 mm^2"}},
      {{0, 3, 0, 0}, {"a volume", "m^3", "1 mm^3"}},
      {{0, 0, 1, 0}, {"a time", "s", "10 ms"}},
      {{0, 0, -1, 0}, {"a frequency", "1/s", "50 Hz"}},
      {{0, 1, -1, 0}, {"a velocity", "m/s", "0.05 m/s"}},
      {{0, 1, -2, 0}, {"an acceleration", "m/s^2", "-9.81 m/s^2"}},
      {{1, 0, 0, 0}, {"a mass", "kg", "1 mg"}},
      {{1, -3, 0, 0}, {"a density", "kg/m^3", "8200 kg/m^3"}},
      {{1, 1, -2, 0}, {"a force", "N", "1 uN"}},
      {{1, 2, -2, 0}, {"an energy", "J", "65 zJ"}},
      {{1, -1, -2, 0}, {"a pressure", "Pa", "1 GPa"}},
      {{1, -1, -2, 0}, {"an energy density", "J/m^3", "1 MJ/m^3"}},
      {{1, 0, -2, 0}, {"a surface energy", "J/m^2", "0.1 mJ/m^2"}},
      {{1, 0, -2, 0}, {"a stiffness", "N/m", "1 kN/m"}},
      {{0, 0, 0, 1}, {"an angle", "rad", "30 deg"}},
      {{0, 0, -1, 1}, {"an angular velocity", "rad/s", "200 rpm"}},
  }};
  return rows.at(static_cast<std::size_t>(dimension));
}

struct Atom {
  std::string_view symbol;
  Powers powers;
  int power_of_ten;
  double factor;
  bool prefixes;  // may a prefix stand before it?
};

constexpr double kPi = std::numbers::pi;
constexpr std::array<Atom, 18> kAtoms{{
    {"m", {0, 1, 0, 0}, 0, 1, true},
    {"g", {1, 0, 0, 0}, -3, 1, true},
    {"s", {0, 0, 1, 0}, 0, 1, true},
    {"N", {1, 1, -2, 0}, 0, 1, true},
    {"dyn", {1, 1, -2, 0}, -5, 1, true},
    {"J", {1, 2, -2, 0}, 0, 1, true},
    {"erg", {1, 2, -2, 0}, -7, 1, true},
    {"eV", {1, 2, -2, 0}, -19, 1.602176634, true},  // exact since 2019
    {"Pa", {1, -1, -2, 0}, 0, 1, true},
    {"Hz", {0, 0, -1, 0}, 0, 1, true},
    {"rad", {0, 0, 0, 1}, 0, 1, true},
    {"bar", {1, -1, -2, 0}, 5, 1, true},
    {"min", {0, 0, 1, 0}, 0, 60, false},
    {"h", {0, 0, 1, 0}, 0, 3600, false},
    {"deg", {0, 0, 0, 1}, 0, kPi / 180, false},
    {"rpm", {0, 0, -1, 1}, 0, kPi / 30, false},
    {"%", {0, 0, 0, 0}, -2, 1, false},
    {"1", {0, 0, 0, 0}, 0, 1, false},
}};

struct Prefix {
  std::string_view symbol;
  int power_of_ten;
};
constexpr std::array<Prefix, 15> kPrefixes{{{"z", -21},
                                            {"a", -18},
                                            {"f", -15},
                                            {"p", -12},
                                            {"n", -9},
                                            {"u", -6},
                                            {"\xC2\xB5", -6},  // the micro sign
                                            {"\xCE\xBC", -6},  // the Greek letter mu
                                            {"m", -3},
                                            {"c", -2},
                                            {"d", -1},
                                            {"k", 3},
                                            {"M", 6},
                                            {"G", 9},
                                            {"T", 12}}};

struct ParsedUnit {
  Powers powers{};
  int power_of_ten = 0;
  double factor = 1;
};

/// Multiplies `unit` by an atom (with or without a prefix) to the power `exponent`.
bool multiply(ParsedUnit& unit, std::string_view symbol, int exponent) {
  auto apply = [&](const Atom& atom, int prefix) {
    for (std::size_t i = 0; i < 4; ++i) unit.powers[i] += exponent * atom.powers[i];
    unit.power_of_ten += exponent * (atom.power_of_ten + prefix);
    if (atom.factor != 1) unit.factor *= std::pow(atom.factor, exponent);
    return true;
  };
  for (const Atom& atom : kAtoms)
    if (symbol == atom.symbol) return apply(atom, 0);
  for (const Prefix& prefix : kPrefixes) {
    if (!symbol.starts_with(prefix.symbol)) continue;
    for (const Atom& atom : kAtoms)
      if (atom.prefixes && symbol.substr(prefix.symbol.size()) == atom.symbol)
        return apply(atom, prefix.power_of_ten);
  }
  return false;
}

/// Reads the exponent after an atom: "^3", "^-2", or a superscript two or three. 1 when there is none, 0 on
/// error.
int take_exponent(std::string_view& text) {
  if (text.starts_with("\xC2\xB2")) return text.remove_prefix(2), 2;
  if (text.starts_with("\xC2\xB3")) return text.remove_prefix(2), 3;
  if (!text.starts_with('^')) return 1;
  text.remove_prefix(1);
  int exponent = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  if (error != std::errc{} || std::abs(exponent) > 9) return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return exponent;
}

/// "kg/m^3": factors joined by '*', '.', a middle dot or a blank (times) and '/' (by; it holds for the next
/// factor).
std::optional<ParsedUnit> parse_unit(std::string_view text) {
  if (text == "1") return std::nullopt;  // good in "1/s" alone
  ParsedUnit unit;
  bool divide = false, factor_due = !text.empty();
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("*/. ^\xC2"), text.size());
    // a micro sign starts with the byte of the superscripts and the middle dot: it belongs to the symbol
    const bool micro = text.substr(end).starts_with("\xC2\xB5");
    const std::size_t length = micro ? std::min(text.find_first_of("*/. ^\xC2", end + 2), text.size()) : end;
    const std::string_view symbol = text.substr(0, length);
    text.remove_prefix(length);
    const int exponent = take_exponent(text);
    if (exponent == 0 || !multiply(unit, symbol, divide ? -exponent : exponent)) return std::nullopt;
    factor_due = false;
    const std::size_t before = text.size();
    while (text.starts_with(' ')) text.remove_prefix(1);
    divide = text.starts_with('/');
    const bool times = text.starts_with('*') || text.starts_with('.') || text.starts_with("\xC2\xB7");
    if (divide || times) text.remove_prefix(text.starts_with("\xC2\xB7") ? 2 : 1), factor_due = true;
    if (!text.empty() && text.size() == before) return std::nullopt;  // two factors with nothing between
    while (text.starts_with(' ')) text.remove_prefix(1);
  }
  if (factor_due) return std::nullopt;
  return unit;
}

/// The length of the decimal number that `text` starts with (0: none).
std::size_t number_length(std::string_view text) {
  std::size_t i = 0;
  const auto digits = [&] {
    const std::size_t start = i;
    while (i < text.size() && text[i] >= '0' && text[i] <= '9') ++i;
    return i - start;
  };
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
  std::size_t mantissa = digits();
  if (i < text.size() && text[i] == '.') ++i, mantissa += digits();
  if (mantissa == 0) return 0;
  const std::size_t whole = i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    ++i;
    if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
    if (digits() == 0) return whole;
  }
  return i;
}

/// number * 10^power, rounded once: the exponent is changed in the text, before the conversion to binary.
std::optional<double> scaled_number(std::string_view number, int power) {
  if (number.starts_with('+')) number.remove_prefix(1);
  double value = 0;
  const auto read = [&value](const char* begin, const char* end) {
    return std::from_chars(begin, end, value).ec == std::errc{} && std::isfinite(value);
  };
  if (power == 0) {
    if (!read(number.data(), number.data() + number.size())) return std::nullopt;
    return value;
  }
  const std::size_t e = number.find_first_of("eE");
  long long exponent = power;
  if (e != std::string_view::npos) {
    std::string_view digits = number.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    long long written = 0;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), written);
    if (result.ec != std::errc{} || std::abs(written) > 100000) return std::nullopt;
    exponent += written;
  }
  fmt::memory_buffer text;  // lists have millions of numbers: nothing is allocated for one
  text.append(number.substr(0, e));
  text.push_back('e');
  text.append(fmt::format_int(exponent));
  if (!read(text.begin(), text.end())) return std::nullopt;
  return value;
}

std::string allowed_text(Dimension dimension) {
  const DimensionInfo& expected = info(dimension);
  if (expected.si_unit.empty()) return "a plain number or a percentage is due";
  return fmt::format("{} is due (SI: {})", expected.noun, expected.si_unit);
}

/// What else a unit might measure, for the message: "is a length".
std::string noun_of(const Powers& powers) {
  for (int i = 0; i <= static_cast<int>(Dimension::angular_velocity); ++i)
    if (row(static_cast<Dimension>(i)).powers == powers)
      return std::string(row(static_cast<Dimension>(i)).info.noun);
  return "something else";
}

QuantityProblem not_a_number(std::string_view text, Dimension expected) {
  const std::string_view decimal =
      text.find(',') != std::string_view::npos ? " (the decimal sign is a point)" : "";
  return {fmt::format("\"{}\" does not start with a finite decimal number{}", text, decimal),
          allowed_text(expected), fmt::format("write for instance \"{}\"", info(expected).example)};
}

}  // namespace

const DimensionInfo& info(Dimension dimension) { return row(dimension).info; }

std::string_view trim(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

bool is_bare_number(std::string_view text) { return !text.empty() && number_length(text) == text.size(); }

std::optional<Unit> Unit::parse(std::string_view text, Dimension expected, QuantityProblem& problem) {
  const auto parsed = parse_unit(trim(text));
  if (!parsed) {
    problem = {fmt::format("\"{}\" is not a unit", text), allowed_text(expected),
               fmt::format("write for instance \"{}\"", info(expected).example)};
    return std::nullopt;
  }
  if (parsed->powers != row(expected).powers) {
    problem = {fmt::format("\"{}\" is the unit of {}", text, noun_of(parsed->powers)), allowed_text(expected),
               fmt::format("write for instance \"{}\"", info(expected).example)};
    return std::nullopt;
  }
  Unit unit;
  unit.power_of_ten_ = parsed->power_of_ten;
  unit.factor_ = parsed->factor;
  return unit;
}

std::optional<double> Unit::value(std::string_view text) const {
  if (!is_bare_number(text)) return std::nullopt;
  const auto decimal = scaled_number(text, power_of_ten_);
  if (!decimal || !std::isfinite(*decimal * factor_)) return std::nullopt;
  return *decimal * factor_;
}

std::optional<double> try_parse_quantity(std::string_view text, Dimension expected,
                                         QuantityProblem& problem) {
  text = trim(text);
  const std::string_view number = text.substr(0, number_length(text));
  if (number.empty()) {
    problem = not_a_number(text, expected);
    return std::nullopt;
  }
  const std::string_view unit_text = trim(text.substr(number.size()));
  if (unit_text.empty() && expected != Dimension::dimensionless) {
    problem = {fmt::format("{} has no unit", number), allowed_text(expected),
               fmt::format("write \"{} {}\" if it is in SI, or for instance \"{}\"", number,
                           info(expected).si_unit, info(expected).example)};
    return std::nullopt;
  }
  const auto unit = Unit::parse(unit_text, expected, problem);
  if (!unit) {
    problem.what = fmt::format("\"{}\": {}", text, problem.what);
    return std::nullopt;
  }
  const auto value = unit->value(number);
  if (!value)
    problem = {fmt::format("{} is too large or too small for a double", text), allowed_text(expected),
               "check the exponent and the unit"};
  return value;
}

double parse_quantity(std::string_view text, Dimension expected, std::string_view key) {
  QuantityProblem problem;
  if (const auto value = try_parse_quantity(text, expected, problem)) return *value;
  throw InputError(fmt::format("{}: {}; {}; {}", key, problem.what, problem.allowed, problem.remedy));
}

}  // namespace interstice::scene
