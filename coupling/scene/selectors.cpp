#include "coupling/scene/selectors.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace interstice::scene {
namespace {

constexpr std::string_view kSliceAllowed = "AXIS=PLACE is due";
constexpr std::string_view kSliceRemedy = "write for instance \"x=4.5 mm\"";
constexpr std::string_view kLineAllowed = "AXIS@AXIS=PLACE,AXIS=PLACE with three different axes is due";
constexpr std::string_view kLineRemedy = "write for instance \"y@x=9 mm,z=35 um\"";

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(at);
    parts.push_back(trim(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<int> axis_of(std::string_view text) {
  text = trim(text);
  if (text.size() != 1 || text[0] < 'x' || text[0] > 'z') return std::nullopt;
  return text[0] - 'x';
}

QuantityProblem malformed(std::string_view text, std::string_view allowed, std::string_view remedy) {
  return {fmt::format("\"{}\" cannot be understood", text), std::string(allowed), std::string(remedy)};
}

[[noreturn]] void fail(std::string_view key, const QuantityProblem& problem) {
  throw InputError(fmt::format("{}: {}; {}; {}", key, problem.what, problem.allowed, problem.remedy));
}

}  // namespace

std::optional<Slice> try_parse_slice(std::string_view text, QuantityProblem& problem) {
  const auto parts = split(text, '=');
  const auto axis = axis_of(parts[0]);
  if (parts.size() != 2 || !axis) {
    problem = malformed(text, kSliceAllowed, kSliceRemedy);
    return std::nullopt;
  }
  const auto at = try_parse_quantity(parts[1], Dimension::length, problem);
  if (!at) return std::nullopt;
  return Slice{*axis, *at};
}

std::optional<Line> try_parse_line(std::string_view text, QuantityProblem& problem) {
  const auto halves = split(text, '@');
  const auto places = split(halves.back(), ',');
  const auto axis = axis_of(halves[0]);
  if (halves.size() != 2 || places.size() != 2 || !axis) {
    problem = malformed(text, kLineAllowed, kLineRemedy);
    return std::nullopt;
  }
  Line line{*axis, {}};
  std::array<bool, 3> taken{};
  taken[static_cast<std::size_t>(*axis)] = true;
  for (const std::string_view place : places) {
    const auto slice = try_parse_slice(place, problem);
    if (!slice) {
      if (problem.allowed == kSliceAllowed) problem = malformed(text, kLineAllowed, kLineRemedy);
      return std::nullopt;
    }
    if (std::exchange(taken[static_cast<std::size_t>(slice->axis)], true)) {
      problem = malformed(text, kLineAllowed, kLineRemedy);
      problem.what = fmt::format("\"{}\" names the axis {} twice", text, "xyz"[slice->axis]);
      return std::nullopt;
    }
    line.at[slice->axis] = slice->at;
  }
  return line;
}

Slice parse_slice(std::string_view text, std::string_view key) {
  QuantityProblem problem;
  const auto slice = try_parse_slice(text, problem);
  if (!slice) fail(key, problem);
  return *slice;
}

Line parse_line(std::string_view text, std::string_view key) {
  QuantityProblem problem;
  const auto line = try_parse_line(text, problem);
  if (!line) fail(key, problem);
  return *line;
}

Box parse_box(std::string_view text, std::string_view key) {
  constexpr std::string_view allowed = "x0,x1,y0,y1,z0,z1 is due, a unit on each, the smaller first";
  constexpr std::string_view remedy = "write for instance \"0 mm,18 mm,-0.75 mm,0.75 mm,0 mm,0.1 mm\"";
  const auto parts = split(text, ',');
  if (parts.size() != 6) fail(key, malformed(text, allowed, remedy));
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(2 * axis);
    box.lo[axis] = parse_quantity(parts[i], Dimension::length, key);
    box.hi[axis] = parse_quantity(parts[i + 1], Dimension::length, key);
    if (!(box.lo[axis] < box.hi[axis]))
      fail(key, {fmt::format("{} to {} is empty along {}", parts[i], parts[i + 1], "xyz"[axis]),
                 std::string(allowed), "swap the two or make the box larger"});
  }
  return box;
}

FieldLayers parse_layers(std::string_view text, std::string_view key) {
  constexpr std::string_view allowed = "z0,z1,NX,NY is due: heights with a unit, counts from 1 to 100000";
  constexpr std::string_view remedy = "write for instance \"0 um,70 um,40,10\"";
  const auto parts = split(text, ',');
  if (parts.size() != 4) fail(key, malformed(text, allowed, remedy));
  FieldLayers layers{parse_length(parts[0], key), parse_length(parts[1], key), {}};
  if (!(layers.z_lo < layers.z_hi)) fail(key, malformed(text, "z0 < z1 is due", "swap the two"));
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::string_view count = parts[axis + 2];
    const auto result = std::from_chars(count.data(), count.data() + count.size(), layers.columns[axis]);
    const bool whole = result.ec == std::errc{} && result.ptr == count.data() + count.size();
    if (!whole || layers.columns[axis] < 1 || layers.columns[axis] > 100000)
      fail(key, malformed(text, allowed, remedy));
  }
  return layers;
}

double parse_length_unit(std::string_view text, std::string_view key) {
  QuantityProblem problem;
  const auto unit = Unit::parse(text, Dimension::length, problem);
  if (!unit) fail(key, problem);
  return *unit->value("1");
}

}  // namespace interstice::scene
