// Settled beds to measure on: made here, or read from a file, and copied side by side to the number of grains
// asked for.
#pragma once

#include <string>
#include <vector>

#include "dem/columns.h"
#include "dem/model.h"
#include "dem/rates.h"

namespace interstice::apps {

/// Grains over [0, size) in x and y, on a floor at z = 0.
struct Bed {
  std::vector<dem::NewGrain> grains;
  Vec3d size;            // [m]
  bool periodic = true;  // in x and y; else walls stand there
};

/// What acts between the grains of a bed, beside Hertz and Mindlin's springs with friction.
struct BedLaws {
  bool cohesion = true;  // SJKR
  bool rolling = true;   // CDT
};

/// How many copies of a bed, and along which axes.
struct Copies {
  int x = 1, y = 1;
};

/// The sizes that made beds have, for messages and help.
inline constexpr const char* kBedSizes =
    "powder (5 to 65 um, paper 004's), equal (40 um), wide (2 to 100 um)";

/// The powder of paper 004 on a floor of another material; `softening` multiplies Young's modulus and keeps
/// pull-off over weight.
dem::Model bed_model(const Bed& bed, const BedLaws& laws, double softening = 1);

/// 0.2 of the Rayleigh time of the smallest grain [s]; where grains take two rates of steps, that of the
/// small.
double bed_time_step(const Bed& bed, const dem::Model& model);

/// Two rates of steps for grains above and below a diameter [m]: as many short ones to each of the others as
/// the smallest above it allow. One rate where that is one. Throws InputError where no grain is below.
dem::Rates bed_rates(const Bed& bed, double short_below);

/// A periodic cell of settled grains, 0.25 mm x 0.25 mm and about 1.5 mm high: a 24th of 35,000. Throws
/// InputError for sizes not named above.
Bed make_bed_cell(const std::string& sizes, const BedLaws& laws);

/// The last frame of a particle file; periodic over the box that the file gives, or between walls.
Bed read_bed(const std::string& path, bool periodic);

/// As many copies as come closest to that many grains, about six times as long along x as along y.
Copies copies_for(const Bed& cell, std::int64_t grains);
Bed tiled(const Bed& cell, const Copies& copies);

/// Makes every other grain one of the walls' material.
void mix_materials(Bed& bed);

/// As a text dump, which other programs and read_bed() read.
void write_bed(const Bed& bed, const std::string& path);

}  // namespace interstice::apps
