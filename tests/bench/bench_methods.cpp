// What each method of the void fraction costs and how far it is off, on a bed of spheres that do not overlap:
//   bench_methods [GRAINS]      a Markdown table, as in docs/METHODS.md (default 4000 grains)
// Diameters are normal by number, mean 39.4 um, sd 10.46 um, cut to 5 to 65 um; the bed is packed by geometry
// to a solid fraction of 0.5 and its spheres then shrunk until the closest pair just touches.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <vector>

#include <openvdb/openvdb.h>

#include "base/random.h"
#include "dem/packing.h"
#include "voxel/field.h"
#include "voxel/methods.h"
#include "voxel/scales.h"

namespace {

using namespace interstice;
using voxel::FieldRequest;
using voxel::Method;

struct Bed {
  std::vector<double> x, y, z, radius;
  Box box;
  double median = 0;  // diameter [m]
  double shrunk = 1;  // factor on all radii

  voxel::SpheresView view() const { return {x.size(), x.data(), y.data(), z.data(), radius.data(), nullptr}; }
};

double volume_of(const std::vector<double>& radii) {
  double volume = 0;
  for (const double r : radii) volume += 4 * std::numbers::pi / 3 * r * r * r;
  return volume;
}

std::vector<double> draw_radii(std::size_t count) {
  std::vector<double> radii;
  Random random(4, 0);
  while (radii.size() < count) {
    const double normal =
        std::sqrt(-2 * std::log(random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
    const double diameter = 39.4e-6 + 10.46e-6 * normal;
    if (diameter >= 5e-6 && diameter <= 65e-6) radii.push_back(0.5 * diameter);
  }
  return radii;
}

/// The largest factor on all radii, at most 1, with which no two spheres overlap (periodic in x and y).
double largest_factor(const Bed& bed) {
  const Vec3d size = bed.box.size();
  double factor = 1;
  for (std::size_t i = 0; i < bed.x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double dx = bed.x[i] - bed.x[j], dy = bed.y[i] - bed.y[j];
      const double dz = bed.z[i] - bed.z[j], reach = bed.radius[i] + bed.radius[j];
      dx -= size.x * std::round(dx / size.x), dy -= size.y * std::round(dy / size.y);
      const double squared = dx * dx + dy * dy + dz * dz;
      if (squared < factor * factor * reach * reach) factor = std::sqrt(squared) / reach;
    }
  return factor;
}

Bed make_bed(std::size_t count) {
  const std::vector<double> radii = draw_radii(count);
  const double edge = std::cbrt(volume_of(radii) / 0.5);
  Bed bed;
  for (const dem::NewGrain& grain : dem::pack_in_cell(radii, edge, edge, 0.5, 7)) {
    bed.x.push_back(grain.position.x);
    bed.y.push_back(grain.position.y);
    bed.z.push_back(grain.position.z);
    bed.radius.push_back(grain.radius);
  }
  bed.box = {{0, 0, 0}, {edge, edge, edge}};
  bed.shrunk = largest_factor(bed);
  for (double& r : bed.radius) r *= bed.shrunk;
  std::vector<double> sorted = bed.radius;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  bed.median = 2 * sorted[sorted.size() / 2];
  return bed;
}

struct Variant {
  Method method;
  int subsample = 0;
  double least_void = 0, kernel_in_medians = 0;
};

FieldRequest request_for(const Bed& bed, const Variant& variant, std::int64_t cells) {
  FieldRequest request;
  const double edge = bed.box.hi.x;
  request.lattice = voxel::cubic_lattice(bed.box, edge / static_cast<double>(cells));
  request.periodic = {true, true, false};
  request.method = variant.method;
  request.subsample = variant.subsample;
  request.least_void = variant.least_void;
  request.kernel_length = variant.kernel_in_medians * bed.median;
  return request;
}

struct Result {
  double microseconds = 0;  // of processor time a sphere, the fastest of several
  double rms = 0, max = 0, deleted = 0;
  double overfull = 0;  // share of voxels with more than 1 + 1e-6 solid
};

Result measure(const Bed& bed, const FieldRequest& request, const voxel::Field& exact) {
  Result result;
  voxel::Field field;
  result.microseconds = INFINITY;
  for (int round = 0; round < 3; ++round) {
    const std::clock_t begin = std::clock();  // of the processor: other programs may run
    field = voxel::compute_field(bed.view(), {}, request);
    const double took = 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    result.microseconds = std::min(result.microseconds, took / static_cast<double>(bed.x.size()));
  }
  const auto& n = request.lattice.n;
  auto ours = field.solid_fraction->getConstAccessor(), truth = exact.solid_fraction->getConstAccessor();
  double squares = 0;
  std::int64_t overfull = 0;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        const double share = static_cast<double>(ours.getValue({i, j, k}));
        const double d = share - static_cast<double>(truth.getValue({i, j, k}));
        squares += d * d;
        result.max = std::max(result.max, std::abs(d));
        overfull += share > 1 + 1e-6;
      }
  const auto cells = static_cast<double>(request.lattice.cells());
  result.rms = std::sqrt(squares / cells);
  result.overfull = static_cast<double>(overfull) / cells;
  result.deleted = field.sums.deleted_volume / field.sums.solid_volume_particles;
  return result;
}

void print_table(const Bed& bed) {
  const std::vector<Variant> variants = {
      {Method::exact},           {Method::centre},          {Method::divided},
      {Method::divided, 0, 0.1}, {Method::subsample, 2},    {Method::subsample, 4},
      {Method::subsample, 8},    {Method::kernel, 0, 0, 1}, {Method::kernel, 0, 0, 2}};
  fmt::print(
      "| h/D50 | method | us/sphere | RMS error | largest error | voxels over 100 % | solid deleted |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const double ratio : {0.1, 0.21, 0.42, 0.85, 1.7, 2.5, 4.0}) {
    const auto cells =
        static_cast<std::int64_t>(std::max(1.0, std::round(bed.box.hi.x / (ratio * bed.median))));
    const voxel::Field exact = voxel::compute_field(bed.view(), {}, request_for(bed, {Method::exact}, cells));
    for (const Variant& variant : variants) {
      const FieldRequest request = request_for(bed, variant, cells);
      const Result r = measure(bed, request, exact);
      const std::string name = variant.method == Method::kernel
                                   ? fmt::format("kernel:{:g} D50", variant.kernel_in_medians)
                                   : voxel::method_name(request);
      fmt::print("| {:.2f} | {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} % | {:.2g} % |\n",
                 request.lattice.h.x / bed.median, name, r.microseconds, r.rms, r.max, 100 * r.overfull,
                 100 * r.deleted);
      std::fflush(stdout);
    }
  }
}

/// From which averaging lengths on this bed's void fraction stands for more than single grains.
void print_scales(const Bed& bed) {
  const auto cells = static_cast<std::int64_t>(std::round(bed.box.hi.x / (0.2 * bed.median)));
  const FieldRequest request = request_for(bed, {Method::exact}, cells);
  const voxel::Field field = voxel::compute_field(bed.view(), {}, request);
  const voxel::ScaleReport report = voxel::void_scales(field, bed.view(), request.periodic);
  fmt::print("\nscales of this bed, in D50: random_length {:.2f}, many_grains_length {:.2f}\n",
             report.random_length / bed.median, report.many_grains_length / bed.median);
}

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
  openvdb::initialize();
  const long count = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 4000;
  if (count < 10 || count > 100000) {
    fmt::print(stderr, "GRAINS is {}; 10 to 100000\n", argc > 1 ? argv[1] : "");
    return 2;
  }
  const Bed bed = make_bed(static_cast<std::size_t>(count));
  fmt::print(
      "{} spheres, D50 {:.3g} um, solid fraction {:.3f} (radii times {:.4f} so that none overlap), one "
      "thread\n\n",
      bed.x.size(), 1e6 * bed.median, volume_of(bed.radius) / bed.box.volume(), bed.shrunk);
  print_table(bed);
  print_scales(bed);
}
