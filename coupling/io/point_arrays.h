// Particles as named arrays over points, as VTK's and other binary files have them, made into a frame.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

/// How a file stores a number.
enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

std::size_t bytes_of(NumberType type);

/// Appends the `count` numbers that `bytes` hold; `swap`: in the other byte order than this machine's.
void append_numbers(const char* bytes, std::size_t count, NumberType type, bool swap,
                    std::vector<double>& to);

/// Is this machine's byte order the big-endian one?
bool machine_is_big_endian();

/// `components` numbers a point, point after point.
struct PointArray {
  std::string name;
  std::size_t components = 1;
  std::vector<double> values;
};

struct PointSet {
  PointArray places{"Points", 3, {}};
  std::vector<PointArray> arrays;
  double time = std::numeric_limits<double>::quiet_NaN();
  std::int64_t step = -1;
};

/// Takes position, size and what else is known by its name. The components of an array `v` of three are
/// called v:0, v:1, v:2 (as ParaView's tables call them), also in --columns. Lengths are in units of
/// options.length_unit. Throws InputError at `where` for an array of another length than the points, a
/// missing size, or a number that is not finite.
ParticleFrame frame_of(const PointSet& set, const ReaderOptions& options, const std::string& where);

}  // namespace interstice::io
