// What a field costs in memory, said before it is computed: so that a command can refuse, wait or adapt
// instead of being killed.
#pragma once

#include <vector>

#include "coupling/io/field_files.h"
#include "coupling/scene/scene.h"

namespace interstice::stream {

/// Cells [number] that spheres of these radii [m] reach at most, in whole leaves: all cells of the lattice
/// where the spheres are many.
double cells_reached(const std::vector<double>& radius, const voxel::FieldRequest& request);

/// Memory [bytes] that computing and writing a field takes at most, above that of its particles' columns:
/// grids near the spheres, lists of spheres, averages over the whole box, the image for ParaView.
double field_memory(const io::FieldFilesRequest& request, double cells, double spheres);

/// The same for a run: its largest field (one is computed at a time) and two copies of its particles.
double fields_memory(const scene::Scene& scene);

/// Throws InputError naming the largest field where fields_memory() is more than `available` [bytes].
void check_fields_memory(const scene::Scene& scene, double available);

}  // namespace interstice::stream
