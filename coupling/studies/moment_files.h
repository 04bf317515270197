// What a run left of one moment of a field, read back: slices, lines, profiles, and where its walls stood.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "coupling/io/particle_frame.h"
#include "coupling/studies/run_folder.h"
#include "coupling/studies/table.h"
#include "voxel/sample.h"

namespace interstice::studies {

/// slices/NAME.csv as it was sampled. Throws InputError where it is no regular plane of voxels.
voxel::Samples read_slice(const std::filesystem::path& csv);

/// A column of a line's table with NaN where walls leave nothing of the voxel; of what is per voxel, where
/// they take any part of it: what is missing there is no powder.
std::vector<double> line_values(const Table& line, const std::string& column);

/// "x=0.0045" as "x = 4.5 mm"; "y@x=0.009,z=3.5e-05" as "along y at x = 9 mm, z = 35 um".
std::string spoken(const std::string& name);
/// The axis a slice is normal to, a line runs along, from its name; -1 where the name says none.
int axis_of(const std::string& name);

/// From trajectory.h5part: the walls of the frame nearest to `time` [s]; none where there is no trajectory
/// that can be read (outlines are an adornment: a comparison does not fail for want of them).
std::vector<io::WallPose> walls_at(const RunFolder& run, double time);

/// "voxel 17.3 µm, exact, averaged over 120 µm", from summary.json; empty where it says nothing.
std::string how_computed(const FieldMoment& moment);

}  // namespace interstice::studies
