// A frame's grains as a field sees them, and what of a recipe the field library is to do with them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/io/particle_frame.h"
#include "coupling/scene/field_recipe.h"
#include "voxel/field.h"

namespace interstice::io {

/// All columns that the frame has.
voxel::SpheresView view_of(const ParticleFrame& frame);

/// Which class each grain is in, and how the classes are called: "size_below_20um", "size_20um_to_40um",
/// "size_from_40um", "material_1", "layer_0".
struct GrainClasses {
  std::vector<std::string> names;
  std::vector<std::int32_t> of;
};

/// Materials and layers as they occur, ascending; `materials` names them by number (for a file that does
/// not: empty). Throws InputError when the frame has no such column, or more than 64 classes.
GrainClasses classify(const ParticleFrame& frame, const scene::FieldClasses& classes,
                      const std::vector<std::string>& materials = {});

/// Method, overlap and quantities; names of classes where there are any.
void apply(const scene::FieldRecipe& recipe, const GrainClasses& classes, voxel::FieldRequest& request);

}  // namespace interstice::io
