// How a field is computed and what it holds, as words: the same on the command line and in scenes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "coupling/scene/units.h"

namespace interstice::scene {

enum class FieldMethod { exact, centre, subsample, divided, kernel };

/// What a field holds beside volume fractions (docs/METHODS.md).
struct FieldQuantities {
  bool velocity = false, temperature = false, diameter = false, coordination = false, stress = false,
       bonded = false;

  bool operator==(const FieldQuantities&) const = default;
};

/// Classes of grains whose solid fraction is told apart.
struct FieldClasses {
  enum class By { none, size, material, layer };
  By by = By::none;
  std::vector<double> edges;  // size: diameters between classes, rising [m]

  bool operator==(const FieldClasses&) const = default;
};

struct FieldRecipe {
  FieldMethod method = FieldMethod::exact;
  int subsample = 0;         // points per voxel edge
  double least_void = 0;     // of divided; 0: none
  double kernel_length = 0;  // [m]
  bool united = false;       // places that spheres share count once
  FieldQuantities quantities;
  FieldClasses classes;

  bool operator==(const FieldRecipe&) const = default;
};

/// Each reads one text into the recipe; on failure false, and `problem` says why.
bool try_read_method(std::string_view text, FieldRecipe& recipe, QuantityProblem& problem);
bool try_read_overlap(std::string_view text, FieldRecipe& recipe, QuantityProblem& problem);
/// One word: "velocity".
bool try_read_field_quantity(std::string_view word, FieldRecipe& recipe, QuantityProblem& problem);
/// "size:20um,40um", "material", "layer" or "none".
bool try_read_classes(std::string_view text, FieldRecipe& recipe, QuantityProblem& problem);
/// Whether method and overlap go together.
bool goes_together(const FieldRecipe& recipe, QuantityProblem& problem);

/// The texts that read back as the same recipe.
std::string method_text(const FieldRecipe& recipe);
std::vector<std::string> quantity_words(const FieldRecipe& recipe);
std::string classes_text(const FieldRecipe& recipe);

}  // namespace interstice::scene
