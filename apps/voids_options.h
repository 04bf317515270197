// What `interstice voids` was asked for: the words of the command line, and what they mean.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/voids_walls.h"
#include "coupling/figures/formats.h"
#include "coupling/io/particle_reader.h"
#include "coupling/scene/scene.h"
#include "voxel/field.h"

namespace interstice::apps {

/// As typed.
struct VoidsWords {
  std::vector<std::string> inputs;
  std::string output, voxel, box, periodic, method = "exact", overlap = "sum", average, average_window,
                                            layers, density, length_unit, frame = "last", columns,
                                            figures = "png", contours, memory, quantities, classes = "none";
  std::vector<std::string> walls, solids, slices, lines;
  bool overwrite = false, no_figures = false, scales = false;
  ComputeOptions compute;
};

enum class Frames { last, one, all };

/// In SI, valid as far as that shows without the particles.
struct VoidsOptions {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;
  double voxel = 0;        // edge [m]
  std::optional<Box> box;  // [m]
  std::array<bool, 3> periodic{false, false, false};
  scene::FieldRecipe recipe;
  double average = 0;  // [m] averaging length; 0: none
  WindowShape window = WindowShape::box;
  bool scales = false;  // void fraction against averaging length as well
  WallOptions walls;
  voxel::Precision precision = voxel::Precision::real64;
  std::vector<scene::Slice> slices;
  std::vector<scene::Line> lines;
  struct Layers {
    double lo = 0, hi = 0;  // [m]
    std::array<std::int64_t, 2> columns{0, 0};
  };
  std::optional<Layers> layers;
  double density = 0;  // [kg/m^3]
  Frames frames = Frames::last;
  std::int64_t frame = 0;  // for Frames::one
  io::ReaderOptions reader;
  bool overwrite = false, figures = true;
  double memory = 0;  // [bytes] that the fields of a batch may take together; 0: by what is free
  figures::Formats formats;
  std::vector<double> contours{0.4, 0.5, 0.6};  // of the averaged void fraction, on slices
};

/// Throws InputError with every error found, one line each.
VoidsOptions read_voids_options(const VoidsWords& words);

/// "bed.final" of "runs/bed.final.dump.gz": the name of an input's folder.
std::string stem_of(const std::filesystem::path& input);

}  // namespace interstice::apps
