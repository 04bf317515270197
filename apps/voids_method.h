// --method and --overlap of `interstice voids`: how a voxel's share of a sphere is found, and how places
// count that spheres share.
#pragma once

#include <string>

#include "voxel/field.h"

namespace interstice::apps {

struct MethodOptions {
  voxel::Method method = voxel::Method::exact;
  int subsample = 0;
  double least_void = 0;     // of divided:LEAST
  double kernel_length = 0;  // [m]
  voxel::Overlap overlap = voxel::Overlap::sum;
  double average = 0;  // [m] averaging length; 0: none
  WindowShape window = WindowShape::box;
  bool scales = false;  // void fraction against averaging length as well
};

/// Throws InputError naming the methods that there are.
void read_method(const std::string& text, MethodOptions& options);
void read_overlap(const std::string& text, MethodOptions& options);
/// After `average` and `scales`.
void read_window(const std::string& text, MethodOptions& options);

/// Both together, as far as that shows without the particles.
void check_together(const MethodOptions& options);

void apply(const MethodOptions& options, voxel::FieldRequest& request);

}  // namespace interstice::apps
