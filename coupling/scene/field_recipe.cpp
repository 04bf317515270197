#include "coupling/scene/field_recipe.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "coupling/scene/format_quantity.h"

namespace interstice::scene {
namespace {

constexpr std::string_view kMethods =
    "exact, centre, divided, divided:LEAST_VOID (such as divided:0.1), subsample:N (such as subsample:4) or "
    "kernel:LENGTH (such as kernel:60um)";
constexpr std::size_t kMostEdges = 31;

using Flag = bool FieldQuantities::*;
constexpr std::array<std::pair<std::string_view, Flag>, 6> kQuantities{{
    {"velocity", &FieldQuantities::velocity},
    {"temperature", &FieldQuantities::temperature},
    {"diameter", &FieldQuantities::diameter},
    {"coordination", &FieldQuantities::coordination},
    {"stress", &FieldQuantities::stress},
    {"bonded", &FieldQuantities::bonded},
}};

bool fail(QuantityProblem& problem, std::string what, std::string allowed, std::string remedy) {
  problem = {std::move(what), std::move(allowed), std::move(remedy)};
  return false;
}

template <class Number>
bool number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool read_subsample(std::string_view text, std::string_view points, FieldRecipe& recipe,
                    QuantityProblem& problem) {
  if (!number(points, recipe.subsample) || recipe.subsample < 1 || recipe.subsample > 64)
    return fail(problem, fmt::format("{}: the points per voxel edge are missing or out of range", text),
                "subsample:1 to subsample:64", "write for example subsample:4");
  recipe.method = FieldMethod::subsample;
  return true;
}

bool read_divided(std::string_view text, std::string_view least, FieldRecipe& recipe,
                  QuantityProblem& problem) {
  if (!number(least, recipe.least_void) || !(recipe.least_void > 0 && recipe.least_void < 1))
    return fail(problem, fmt::format("{}: the least void fraction is no number between 0 and 1", text),
                "divided:LEAST_VOID", "write for example divided:0.1, or divided to delete nothing");
  return true;
}

bool read_kernel(std::string_view text, std::string_view length, FieldRecipe& recipe,
                 QuantityProblem& problem) {
  if (length.empty())
    return fail(problem, fmt::format("{}: the kernel's length is missing", text), "kernel:LENGTH",
                "write for example kernel:60um");
  const auto value = try_parse_quantity(length, Dimension::length, problem);
  if (!value) {
    problem.what = fmt::format("{}: the kernel's length: {}", text, problem.what);
    return false;
  }
  if (!(*value > 0))
    return fail(problem, fmt::format("{}: the kernel's length is not positive", text), "lengths above 0",
                "write for example kernel:60um");
  recipe.method = FieldMethod::kernel;
  recipe.kernel_length = *value;
  return true;
}

}  // namespace

bool try_read_method(std::string_view text, FieldRecipe& recipe, QuantityProblem& problem) {
  recipe.subsample = 0, recipe.least_void = 0, recipe.kernel_length = 0;
  const auto colon = text.find(':');
  const std::string_view name = text.substr(0, colon);
  const bool more = colon != std::string_view::npos;
  const std::string_view rest = more ? text.substr(colon + 1) : std::string_view();
  if (name == "subsample") return read_subsample(text, rest, recipe, problem);
  if (name == "kernel") return read_kernel(text, rest, recipe, problem);
  if (name == "divided") {
    recipe.method = FieldMethod::divided;
    return !more || read_divided(text, rest, recipe, problem);
  }
  if (text != "exact" && text != "centre" && text != "center")
    return fail(problem, fmt::format("{} is no method", text), std::string(kMethods), "use exact");
  recipe.method = text == "exact" ? FieldMethod::exact : FieldMethod::centre;
  return true;
}

bool try_read_overlap(std::string_view text, FieldRecipe& recipe, QuantityProblem& problem) {
  if (text != "sum" && text != "union")
    return fail(problem, fmt::format("{} is not known", text), "sum or union", "leave it out for sum");
  recipe.united = text == "union";
  return true;
}

bool try_read_field_quantity(std::string_view word, FieldRecipe& recipe, QuantityProblem& problem) {
  std::vector<std::string_view> names;
  for (const auto& [name, flag] : kQuantities) {
    if (word == name) {
      recipe.quantities.*flag = true;
      return true;
    }
    names.push_back(name);
  }
  return fail(problem, fmt::format("{} is no quantity", word), fmt::format("{}", fmt::join(names, ", ")),
              "correct it (solid and void fraction are always there, mass density where a density is known)");
}

bool try_read_classes(std::string_view text, FieldRecipe& recipe, QuantityProblem& problem) {
  using By = FieldClasses::By;
  constexpr const char* allowed =
      "size:DIAMETER,DIAMETER,... (such as size:20um,40um), material, layer or none";
  recipe.classes = {};
  if (text == "none") return true;
  if (text == "material" || text == "layer") {
    recipe.classes.by = text == "layer" ? By::layer : By::material;
    return true;
  }
  if (!text.starts_with("size:"))
    return fail(problem, fmt::format("{} are no classes", text), allowed, "write for example size:20um,40um");
  std::string_view rest = text.substr(5);
  for (bool last = false; !last;) {
    const auto comma = rest.find(',');
    last = comma == std::string_view::npos;
    const auto edge = try_parse_quantity(trim(rest.substr(0, comma)), Dimension::length, problem);
    if (!edge) return false;
    const double before = recipe.classes.edges.empty() ? 0 : recipe.classes.edges.back();
    if (!(*edge > before))
      return fail(problem, fmt::format("{}: diameters between classes do not rise", text),
                  "diameters above 0, the smallest first", "sort them");
    recipe.classes.edges.push_back(*edge);
    if (!last) rest.remove_prefix(comma + 1);
  }
  if (recipe.classes.edges.size() > kMostEdges)
    return fail(problem, fmt::format("{} classes", recipe.classes.edges.size() + 1),
                fmt::format("at most {}", kMostEdges + 1), "leave some out");
  recipe.classes.by = By::size;
  return true;
}

bool goes_together(const FieldRecipe& recipe, QuantityProblem& problem) {
  if (!recipe.united || recipe.method == FieldMethod::exact) return true;
  return fail(problem, "union needs the method exact", "the other methods sum over spheres",
              "leave one of the two out");
}

std::string method_text(const FieldRecipe& recipe) {
  switch (recipe.method) {
    case FieldMethod::exact:
      return "exact";
    case FieldMethod::centre:
      return "centre";
    case FieldMethod::subsample:
      return fmt::format("subsample:{}", recipe.subsample);
    case FieldMethod::divided:
      return recipe.least_void > 0 ? fmt::format("divided:{}", recipe.least_void) : "divided";
    case FieldMethod::kernel:
      return fmt::format("kernel:{}", format_exact(recipe.kernel_length, Dimension::length));
  }
  return {};
}

std::vector<std::string> quantity_words(const FieldRecipe& recipe) {
  std::vector<std::string> words;
  for (const auto& [name, flag] : kQuantities)
    if (recipe.quantities.*flag) words.emplace_back(name);
  return words;
}

std::string classes_text(const FieldRecipe& recipe) {
  using By = FieldClasses::By;
  if (recipe.classes.by == By::none) return "none";
  if (recipe.classes.by != By::size) return recipe.classes.by == By::layer ? "layer" : "material";
  std::vector<std::string> edges;
  for (const double edge : recipe.classes.edges) edges.push_back(format_exact(edge, Dimension::length));
  return fmt::format("size:{}", fmt::join(edges, ","));
}

}  // namespace interstice::scene
