#include "apps/voids_options.h"

#include <fmt/format.h>

#include <charconv>
#include <map>

#include "base/error.h"
#include "coupling/scene/selectors.h"
#include "coupling/scene/units.h"

namespace interstice::apps {
namespace {

using scene::Dimension;

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  for (;;) {
    const std::size_t to = std::min(text.find(separator, at), text.size());
    parts.emplace_back(scene::trim(std::string_view(text).substr(at, to - at)));
    if (to == text.size()) return parts;
    at = to + 1;
  }
}

bool whole_number(const std::string& text, std::int64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

double positive(const std::string& text, Dimension dimension, const char* key) {
  const double value = scene::parse_quantity(text, dimension, key);
  if (!(value > 0)) {
    throw InputError(fmt::format("{}: {} is not positive; {} above 0; correct it", key, text,
                                 scene::info(dimension).noun));
  }
  return value;
}

void read_periodic(const std::string& text, VoidsOptions& options) {
  for (const char c : text) {
    if (c < 'x' || c > 'z') {
      throw InputError("--periodic: " + text +
                       ": not a list of axes; letters out of x, y, z; write for example xy");
    }
    options.periodic[static_cast<std::size_t>(c - 'x')] = true;
  }
}

void read_layers(const std::string& text, VoidsOptions& options) {
  const auto parts = parts_of(text, ',');
  if (parts.size() != 4) {
    throw InputError("--layers: " + text +
                     ": four values are due; z0,z1,NX,NY; write for example 0um,70um,40,10");
  }
  VoidsOptions::Layers layers;
  layers.lo = scene::parse_quantity(parts[0], Dimension::length, "--layers");
  layers.hi = scene::parse_quantity(parts[1], Dimension::length, "--layers");
  if (!(layers.hi > layers.lo)) {
    throw InputError("--layers: " + text + ": the layer has no height; z0 below z1; swap or correct them");
  }
  for (std::size_t a = 0; a < 2; ++a) {
    if (!whole_number(parts[2 + a], layers.columns[a]) || layers.columns[a] < 1 ||
        layers.columns[a] > 10000) {
      throw InputError("--layers: " + parts[2 + a] + ": no number of columns; 1 to 10000; correct it");
    }
  }
  options.layers = layers;
}

void read_frame(const std::string& text, VoidsOptions& options) {
  if (text == "last") return;
  if (text == "all") {
    options.frames = Frames::all;
    return;
  }
  options.frames = Frames::one;
  if (!whole_number(text, options.frame) || options.frame < 0) {
    throw InputError("--frame: " + text + " is no frame; a number from 0, last or all; correct it");
  }
}

void read_columns(const std::string& text, VoidsOptions& options) {
  for (const auto& part : parts_of(text, ',')) {
    const auto at = part.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == part.size()) {
      throw InputError("--columns: " + part +
                       ": no pair; OURS=THEIRS, separated by commas; write for example "
                       "radius=c_r,x=c_x");
    }
    options.reader.columns[part.substr(0, at)] = part.substr(at + 1);
  }
}

/// Runs one of field_recipe.h's readers; throws InputError led by the option's name.
template <class Read>
void read_words(const char* key, const Read& read) {
  scene::QuantityProblem problem;
  if (!read(problem))
    throw InputError(fmt::format("{}: {}; {}; {}", key, problem.what, problem.allowed, problem.remedy));
}

void read_recipe(const VoidsWords& words, scene::FieldRecipe& recipe) {
  read_words("--method",
             [&](auto& problem) { return scene::try_read_method(words.method, recipe, problem); });
  read_words("--overlap", [&](auto& problem) {
    return scene::try_read_overlap(words.overlap, recipe, problem) && scene::goes_together(recipe, problem);
  });
}

void read_quantities(const VoidsWords& words, scene::FieldRecipe& recipe) {
  if (words.quantities.empty()) return;
  for (const auto& word : parts_of(words.quantities, ','))
    read_words("--quantities",
               [&](auto& problem) { return scene::try_read_field_quantity(word, recipe, problem); });
}

/// After `average` and `scales`.
void read_window(const std::string& text, VoidsOptions& options) {
  const auto window = window_named(text);
  if (!window)
    throw InputError("--average-window: " + text +
                     " is no window; box, sphere or gaussian; leave the option out for box");
  if (!(options.average > 0) && !options.scales)
    throw InputError("--average-window: " + text +
                     " has nothing to average; --average LENGTH or --scales beside it; add one of them");
  options.window = *window;
}

void read_contours(const std::string& text, VoidsOptions& options) {
  options.contours.clear();
  for (const auto& part : parts_of(text, ',')) {
    double level = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), level);
    if (error != std::errc() || end != part.data() + part.size() || !(level > 0 && level < 1)) {
      throw InputError(
          "--contours: " + part +
          " is no level of void fraction; numbers between 0 and 1, separated by commas; write for "
          "example 0.4,0.5,0.6");
    }
    options.contours.push_back(level);
  }
}

// "4GB", "500 MB", "2GiB"
void read_memory(const std::string& text, VoidsOptions& options) {
  const auto unit_at = text.find_first_not_of("0123456789.");
  const std::string unit(scene::trim(std::string_view(text).substr(std::min(unit_at, text.size()))));
  const std::map<std::string, double> units{{"MB", 1e6}, {"GB", 1e9}, {"MiB", 0x1p20}, {"GiB", 0x1p30}};
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + std::min(unit_at, text.size()), value);
  if (error != std::errc() || units.count(unit) == 0 || !(value > 0)) {
    throw InputError(
        "--memory: " + text +
        ": no amount of memory; a number above 0 with MB, GB, MiB or GiB; write for example 4GB");
  }
  options.memory = value * units.at(unit);
}

void read_inputs(const VoidsWords& words, VoidsOptions& options, std::vector<std::string>& errors) {
  std::map<std::string, std::string> by_stem;
  for (const auto& input : words.inputs) {
    const auto [it, fresh] = by_stem.emplace(stem_of(input), input);
    if (!fresh) {
      errors.push_back(
          fmt::format("{}: would write to the same folder `{}` as {}; inputs must differ in name; rename "
                      "one, or use two calls with two -o",
                      input, it->first, it->second));
    }
    options.inputs.emplace_back(input);
  }
  options.output = words.output;
}

}  // namespace

std::string stem_of(const std::filesystem::path& input) {
  std::filesystem::path name = input.filename();
  if (name.extension() == ".gz") name = name.stem();
  return name.stem().string();
}

VoidsOptions read_voids_options(const VoidsWords& words) {
  VoidsOptions options;
  std::vector<std::string> errors;
  const auto attempt = [&](bool given, const auto& read) {
    if (!given) return;
    try {
      read();
    } catch (const InputError& error) {
      errors.insert(errors.end(), error.messages().begin(), error.messages().end());
    }
  };
  read_inputs(words, options, errors);
  attempt(true, [&] { options.voxel = positive(words.voxel, Dimension::length, "--voxel"); });
  attempt(!words.box.empty(), [&] { options.box = scene::parse_box(words.box, "--box"); });
  attempt(true, [&] { read_periodic(words.periodic, options); });
  attempt(true, [&] { read_recipe(words, options.recipe); });
  attempt(true, [&] { read_quantities(words, options.recipe); });
  attempt(true, [&] {
    read_words("--classes", [&](auto& problem) {
      return scene::try_read_classes(words.classes, options.recipe, problem);
    });
  });
  options.scales = words.scales;
  if (words.compute.precision == "mixed") options.precision = voxel::Precision::mixed;
  attempt(!words.average.empty(), [&] {
    options.average = positive(words.average, Dimension::length, "--average");
    if (options.average < options.voxel)
      throw InputError("--average: " + words.average + " is less than a voxel; at least " + words.voxel +
                       "; average over several voxels");
  });
  attempt(!words.average_window.empty(), [&] { read_window(words.average_window, options); });
  for (const auto& slice : words.slices) {
    attempt(true, [&] {
      const auto parsed = scene::parse_slice(slice, "--slice");
      for (const auto& other : options.slices) {
        if (other == parsed) return;  // asked for twice, written once
      }
      options.slices.push_back(parsed);
    });
  }
  for (const auto& line : words.lines) {
    attempt(true, [&] {
      const auto parsed = scene::parse_line(line, "--line");
      for (const auto& other : options.lines) {
        if (other == parsed) return;
      }
      options.lines.push_back(parsed);
    });
  }
  attempt(!words.layers.empty(), [&] { read_layers(words.layers, options); });
  attempt(!words.density.empty(),
          [&] { options.density = positive(words.density, Dimension::density, "--density"); });
  attempt(!words.length_unit.empty(), [&] {
    options.reader.length_unit = scene::parse_length_unit(words.length_unit, "--length-unit");
    options.reader.length_unit_given = true;
  });
  attempt(true, [&] { read_frame(words.frame, options); });
  attempt(!words.columns.empty(), [&] { read_columns(words.columns, options); });
  attempt(!words.memory.empty(), [&] { read_memory(words.memory, options); });
  attempt(true, [&] { options.formats = figures::parse_formats(words.figures, "--figures"); });
  attempt(!words.contours.empty(), [&] { read_contours(words.contours, options); });
  for (const auto& wall : words.walls) attempt(true, [&] { read_mesh(wall, options.walls); });
  for (const auto& solid : words.solids) attempt(true, [&] { read_solid(solid, options.walls); });
  if (!errors.empty()) throw InputError(errors);
  options.overwrite = words.overwrite;
  options.figures = !words.no_figures;
  return options;
}

}  // namespace interstice::apps
