// How a frame lies in a trajectory.h5part: the names that the writer and the reader share. See docs/FILES.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/io/hdf5_handles.h"
#include "coupling/io/particle_frame.h"

namespace interstice::io::layout {

inline constexpr const char* kFormat = "interstice-trajectory";
inline constexpr std::int64_t kVersion = 1;

template <class Value>
struct Column {
  const char* name;
  std::vector<Value> ParticleFrame::*values;
};

// The order is that of the documentation. ParaView takes the list of columns from the first frame.
inline constexpr std::array<Column<double>, 11> kReal{{{"x", &ParticleFrame::x},
                                                       {"y", &ParticleFrame::y},
                                                       {"z", &ParticleFrame::z},
                                                       {"radius", &ParticleFrame::radius},
                                                       {"velocity_0", &ParticleFrame::vx},
                                                       {"velocity_1", &ParticleFrame::vy},
                                                       {"velocity_2", &ParticleFrame::vz},
                                                       {"omega_0", &ParticleFrame::wx},
                                                       {"omega_1", &ParticleFrame::wy},
                                                       {"omega_2", &ParticleFrame::wz},
                                                       {"density", &ParticleFrame::density}}};
inline constexpr std::array<Column<std::int64_t>, 1> kLong{{{"id", &ParticleFrame::id}}};
inline constexpr std::array<Column<std::int32_t>, 3> kShort{{{"material", &ParticleFrame::material},
                                                             {"layer", &ParticleFrame::layer},
                                                             {"bonded", &ParticleFrame::bonded}}};

/// x, y, z and radius are in every frame.
inline bool required(const std::string& column) {
  return column == "x" || column == "y" || column == "z" || column == "radius";
}

inline constexpr const char* kWallGroup = "Walls";
inline std::string step_name(std::int64_t frame) { return "Step#" + std::to_string(frame); }

/// One row of a wall table: "plane" (point, normal) or "box" (lo, hi); unused values are 0.
inline constexpr std::size_t kWallKindBytes = 16;
inline constexpr std::size_t kWallValues = 8;
struct WallRow {
  const char* kind;
  std::array<double, kWallValues> values;
};
WallRow wall_row(const Shape& shape);

/// The compound type of a row whose names take `name_bytes`: {name, kind, values[8]}.
Hdf5Handle wall_type(std::size_t name_bytes);

/// Over every value of the frame; kept with it, because HDF5's oldest format guards only what is compressed.
std::int64_t checksum(const ParticleFrame& frame);

}  // namespace interstice::io::layout
