// Slices, lines and layers of a field as CSV text. Numbers are the shortest that read back as the same value.
#pragma once

#include <string>

#include "voxel/layer.h"
#include "voxel/sample.h"
#include "voxel/scales.h"

namespace interstice::io {

/// "velocity_x_m_s", "temperature_m2_s2", "coordination": a quantity's name with its unit.
std::string column_name(const std::string& quantity, const std::string& units);

/// x_m,y_m,z_m,void_fraction,solid_fraction,mass_density_kg_m3[,void_fraction_averaged], then what else the
/// field holds, each with its average; a row per voxel. What is not known, or has no value there, is nan.
std::string csv_of(const voxel::Samples& samples);

/// x_m,y_m,solid_fraction,mass_density_kg_m3,solid_height_m,surface_height_m,solid_fraction_below_surface; a
/// row per column, x fastest.
std::string csv_of(const voxel::LayerColumns& columns);

/// The layer's numbers along x (axis 0) or y (axis 1), averaged over the other.
std::string csv_of(const voxel::LayerProfile& profile, int axis);

/// length_m,windows,independent_windows,grains_per_window,void_fraction_mean,..._sd,..._min,..._max,sd_random,
/// sd_one_grain; a row per averaging length.
std::string csv_of(const voxel::ScaleReport& report);

/// From which averaging lengths on a void fraction stands for more than a grain, in a sentence.
std::string sentence_of(const voxel::ScaleReport& report);

}  // namespace interstice::io
