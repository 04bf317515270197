// Void-fraction fields: where, how fine, how often, and what is drawn from them.
#include <fmt/format.h>

#include <cmath>

#include "coupling/scene/format_quantity.h"
#include "coupling/scene/readers.h"
#include "coupling/scene/selectors.h"

namespace interstice::scene {
namespace {

constexpr std::int64_t kMostColumns = 100000;
constexpr double kMostKernelVoxels = 1000;  // as voxel::check_method has it

std::string example_inside(const Box& box, int axis) {
  return format_length(0.5 * (box.lo[axis] + box.hi[axis]));
}

void check_inside(const TableReader& table, const std::string& path, const Place& place, const Box& box,
                  int axis, double at) {
  if (at < box.lo[axis] || at >= box.hi[axis])
    table.problems().error(place, path,
                           fmt::format("{} = {} is outside the field's box", "xyz"[axis], format_length(at)),
                           fmt::format("{} to {} is allowed, the upper end excluded",
                                       format_length(box.lo[axis]), format_length(box.hi[axis])),
                           fmt::format("write for instance {} = {}", "xyz"[axis], example_inside(box, axis)));
}

void read_selectors(const TableReader& table, Field& field) {
  Problems& problems = table.problems();
  const auto slices = table.texts("slices");
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const Place place = table.raw("slices")->items[i].place;
    const std::string path = fmt::format("{}.{}", table.path("slices"), i);
    QuantityProblem problem;
    if (const auto slice = try_parse_slice(slices[i], problem)) {
      check_inside(table, path, place, field.box, slice->axis, slice->at);
      field.slices.push_back(*slice);
    } else {
      problems.error(place, path, problem.what, problem.allowed, problem.remedy);
    }
  }
  const auto lines = table.texts("lines");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Place place = table.raw("lines")->items[i].place;
    const std::string path = fmt::format("{}.{}", table.path("lines"), i);
    QuantityProblem problem;
    if (const auto line = try_parse_line(lines[i], problem)) {
      for (int axis = 0; axis < 3; ++axis)
        if (axis != line->axis) check_inside(table, path, place, field.box, axis, line->at[axis]);
      field.lines.push_back(*line);
    } else {
      problems.error(place, path, problem.what, problem.allowed, problem.remedy);
    }
  }
}

void read_columns(const TableReader& table, FieldLayers& layers) {
  const Value* value = table.raw("columns");
  if (!value) return;
  bool good = value->kind == Value::Kind::array && value->items.size() == 2;
  for (const Value& item : value->items)
    good = good && item.kind == Value::Kind::integer && item.integer >= 1 && item.integer <= kMostColumns;
  if (!good) {
    table.error("columns", "is not two counts", fmt::format("[NX, NY], each 1 to {}, is due", kMostColumns),
                "write for instance columns = [40, 10]");
    return;
  }
  layers.columns = {static_cast<int>(value->items[0].integer), static_cast<int>(value->items[1].integer)};
}

FieldLayers read_layers(const TableReader& table, const Box& box) {
  FieldLayers layers{box.lo.z, box.hi.z, {40, 10}};
  if (const auto z = table.interval("z")) {
    layers.z_lo = (*z)[0];
    layers.z_hi = (*z)[1];
    if (layers.z_lo < box.lo.z || layers.z_hi > box.hi.z)
      table.error("z", "reaches outside the field's box",
                  fmt::format("{} to {} is allowed", format_length(box.lo.z), format_length(box.hi.z)),
                  "make it smaller, or the field's box larger");
  }
  read_columns(table, layers);
  return layers;
}

/// Voxels are indexed by 32-bit integers, and a field is only sparse where there is nothing.
void check_voxels(const TableReader& table, const Field& field) {
  double voxels = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = std::ceil(field.box.size()[axis] / field.voxel);
    if (along > 1e9)
      return table.error(
          "voxel",
          fmt::format("{} makes {:.3g} voxels along {}", format_length(field.voxel), along, "xyz"[axis]),
          "at most 1e9 along an axis are allowed", "make the voxels larger or the box smaller");
    voxels *= along;
  }
  if (voxels > 2e9)
    table.problems().warn(table.place("voxel"), table.path("voxel"),
                          fmt::format("the field has {:.3g} voxels, some {:.3g} GB where powder fills it",
                                      voxels, voxels * 8e-9),
                          "make the voxels larger or the box smaller if that is too many");
}

/// The words of field_recipe.h, each problem at its own place.
FieldRecipe read_recipe(const TableReader& table) {
  FieldRecipe recipe;
  QuantityProblem problem;
  const auto error = [&](const char* key) {
    table.error(key, problem.what, problem.allowed, problem.remedy);
  };
  if (const std::string text = table.text("method"); !text.empty() && !try_read_method(text, recipe, problem))
    error("method");
  recipe.united = table.choice("overlap") == "union";
  if (!goes_together(recipe, problem)) error("overlap");
  const auto words = table.texts("quantities");
  for (std::size_t i = 0; i < words.size(); ++i)
    if (!try_read_field_quantity(words[i], recipe, problem))
      table.problems().error(table.raw("quantities")->items[i].place,
                             fmt::format("{}.{}", table.path("quantities"), i), problem.what, problem.allowed,
                             problem.remedy);
  if (const std::string text = table.text("classes");
      !text.empty() && !try_read_classes(text, recipe, problem))
    error("classes");
  return recipe;
}

Field read_field(const TableReader& table) {
  Field field;
  field.name = table.text("name");
  field.voxel = table.quantity("voxel");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  field.box = table.box("box").value_or(Box{{nan, nan, nan}, {nan, nan, nan}});
  field.every = table.optional_quantity("every");
  field.average = table.quantity("average");
  if (field.average > 0 && field.average < field.voxel)
    table.error("average", fmt::format("{} is less than a voxel", format_length(field.average)),
                fmt::format("at least {} (or 0 m for none) is allowed", format_length(field.voxel)),
                "average over several voxels");
  field.average_window = window_named(table.choice("average_window")).value_or(WindowShape::box);
  field.scales = table.boolean("scales");
  field.recipe = read_recipe(table);
  if (field.recipe.kernel_length > kMostKernelVoxels * field.voxel)
    table.error("method", "the kernel's length is more than 1000 voxels", "at most 1000 voxels are allowed",
                "make the kernel shorter or the voxels larger");
  field.periodic_from_domain = table.boolean("periodic_from_domain");
  check_voxels(table, field);
  read_selectors(table, field);
  const TableReader layers(table.raw("layers"), section("fields.layers"), table.path("layers"), table.place(),
                           table.problems());
  field.layers = layers ? read_layers(layers, field.box) : FieldLayers{};
  return field;
}

}  // namespace

std::vector<Field> read_fields(const TableReader& root) {
  std::vector<Field> fields;
  const auto tables = root.tables("fields");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const TableReader table(tables[i], section("fields"), root.element_path("fields", i), root.place(),
                            root.problems());
    fields.push_back(table ? read_field(table) : Field{});
  }
  return fields;
}

}  // namespace interstice::scene
