// How many others each grain touches, from places and sizes alone: for files that list no contacts.
#pragma once

#include <vector>

#include "coupling/io/particle_frame.h"
#include "voxel/field.h"

namespace interstice::stream {

/// Surfaces that are nearer than this part of the sum of the radii count as touching: what rounding leaves of
/// a distance of 0, and nothing more.
inline constexpr double kTouchingGap = 1e-6;

/// Throws InputError where the box repeats in less than two grains: contacts cannot be told apart there.
void check_touching(const io::ParticleFrame& frame, const voxel::FieldRequest& request);

/// How many grains of the frame and how many solids (the frame's walls among them) each grain touches, across
/// the faces along which `request` repeats its box (grains lie in it along those). Of a frame that
/// check_touching let pass.
std::vector<double> touching_grains(const io::ParticleFrame& frame, const voxel::Solids& solids,
                                    const voxel::FieldRequest& request);

}  // namespace interstice::stream
