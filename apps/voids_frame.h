// One frame of particles made ready for its field: the box, the lattice, and whether all that was asked for
// fits.
#pragma once

#include <string>

#include "apps/voids_options.h"
#include "coupling/io/field_files.h"
#include "coupling/io/field_grains.h"
#include "coupling/io/particle_frame.h"
#include "voxel/solids.h"

namespace interstice::apps {

struct FramePlan {
  io::FieldFilesRequest request;  // computed, box, slices, lines and layers filled
  voxel::Solids solids;
  double memory = 0;  // [bytes] that the field takes at most, above the particles (field_memory.h)
  io::GrainClasses classes;
};

/// Throws InputError (led by `where`) when the frame and the options do not go together: a slice outside, a
/// period that is no multiple of the voxel, a quantity whose columns are missing, a field that would not fit
/// into memory.
FramePlan plan_frame(const io::ParticleFrame& frame, const VoidsOptions& options, const std::string& where);

/// What to say of positions that the file tells apart by `resolution` [m] only; "" where that is less than a
/// thousandth of the voxel.
std::string resolution_warning(const std::string& where, double resolution, double voxel);

/// Moves grains by whole periods into the box along the periodic axes, where a dump has them unwrapped.
void wrap(io::ParticleFrame& frame, const voxel::FieldRequest& request);

}  // namespace interstice::apps
