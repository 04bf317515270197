// What fields may take together, and whether they keep to what was said of them.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "coupling/stream/field_memory.h"
#include "coupling/stream/memory_budget.h"

namespace interstice::stream {
namespace {

TEST(MemoryBudget, WorkTogetherNeverTakesMore) {
  constexpr double budget_bytes = 1000;
  MemoryBudget budget(budget_bytes);
  std::atomic<int> taken{0}, most{0}, alone{0};
  const auto worker = [&](unsigned seed) {
    Random random(seed, 0);
    for (int job = 0; job < 200; ++job) {
      const int bytes = job % 50 == 0 ? 1500 : static_cast<int>(random.uniform(1, 700));
      const MemoryBudget::Share share(budget, bytes);
      const int now = taken += bytes;
      for (int before = most; bytes <= 1000 && now > before && !most.compare_exchange_weak(before, now);) {
      }
      if (bytes > 1000) alone += now == bytes;  // larger than all there is: when nobody else works
      std::this_thread::yield();
      taken -= bytes;
    }
  };
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 4; ++t) threads.emplace_back(worker, t);
  for (auto& thread : threads) thread.join();
  EXPECT_LE(most, 1000);
  EXPECT_EQ(alone, 4 * 4);
}

TEST(MemoryBudget, WorkThatFitsIsDoneAtOnceAndTheRestWaits) {
  MemoryBudget budget(1000);
  std::atomic<bool> freed{false}, waited{false};
  std::thread third;
  {
    const MemoryBudget::Share first(budget, 400),
        second(budget, 600);  // would wait forever were it one by one
    third = std::thread([&] {
      const MemoryBudget::Share share(budget, 1);
      waited = freed.load();
    });
    freed = true;
  }
  third.join();
  EXPECT_TRUE(waited);
}

double status(const char* key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key, 0) == 0) return 1024 * std::stod(line.substr(std::strlen(key) + 1));
  }
  return NAN;
}

/// Highest memory of this process while a field over a floor is computed, above that before it [bytes].
double peak_of(const voxel::SpheresView& spheres, const voxel::FieldRequest& request) {
  malloc_trim(0);  // or the field would be put where another was
  std::ofstream("/proc/self/clear_refs") << "5";
  const double before = status("VmRSS:");
  const voxel::Solids floor{{Plane{{0, 0, 0.02e-3}, {0, 0, 1}}}};
  const voxel::Field field = voxel::compute_field(spheres, floor, request);
  return status("VmHWM:") - before;
}

struct Asked {
  double voxel, average;
  WindowShape window = WindowShape::box;
  voxel::QuantityRequest quantities = {};
};

std::vector<Asked> asked_of_fields() {
  const voxel::QuantityRequest all{true, true, true, true, true, true, {"one", "two"}};
  std::vector<Asked> asked;
  for (const double voxel : {100e-6, 17.3e-6, 8e-6})
    for (const double average : {0., 100e-6}) asked.push_back({voxel, average});
  for (const auto window : {WindowShape::sphere, WindowShape::gaussian})
    asked.push_back({10e-6, 40e-6, window});
  for (const double average : {0., 60e-6}) asked.push_back({15e-6, average, WindowShape::box, all});
  return asked;
}

TEST(FieldMemory, IsNotMoreThanSaid) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "a sanitizer takes memory of its own";
#endif
  std::ofstream reset("/proc/self/clear_refs");
  if (!(reset << "5" << std::flush)) GTEST_SKIP() << "peaks of memory cannot be reset here";
  const std::size_t count = 60'000;
  std::vector<double> x, y, z, r, number(count, 1.0);
  std::vector<std::int32_t> kind(count);
  for (std::size_t s = 0; s < count; ++s) {
    Random random(3, s);
    x.push_back(random.uniform(0, 4e-3));
    y.push_back(random.uniform(0, 2e-3));
    z.push_back(random.uniform(0, .5e-3));
    r.push_back(random.uniform(10e-6, 25e-6));
    number[s] = random.uniform(1, 2);
    kind[s] = s % 2;
  }
  voxel::SpheresView spheres{count, x.data(), y.data(), z.data(), r.data(), number.data()};
  spheres.velocity.fill(number.data()), spheres.stress.fill(number.data());
  spheres.coordination = number.data();
  spheres.bonded = spheres.group = kind.data();
  for (const Asked& asked : asked_of_fields()) {
    io::FieldFilesRequest request;
    request.vti = false;  // computing alone is measured
    request.computed.lattice = voxel::cubic_lattice({{0, 0, 0}, {4e-3, 2e-3, .5e-3}}, asked.voxel);
    request.computed.average_length = asked.average;
    request.computed.average_window = asked.window;
    request.computed.quantities = asked.quantities;
    const double said = field_memory(request, cells_reached(r, request.computed), count);
    const double taken = peak_of(spheres, request.computed);
    EXPECT_LE(taken, said) << asked.voxel << " " << asked.average << " " << name_of(asked.window) << " "
                           << asked.quantities.grids();
    EXPECT_GT(taken, 0.05 * said) << asked.voxel << " " << asked.average;  // and not without measure
  }
}

TEST(FieldMemory, OfARunCountsItsClasses) {
  scene::Scene scene;
  scene::Field field;
  field.name = "layer";
  field.voxel = 1e-2;
  field.box = {{0, 0, 0}, {1, 1, 1}};
  scene.fields = {field};
  const double plain = fields_memory(scene);
  scene.fields[0].recipe.classes = {scene::FieldClasses::By::size, {1e-3, 2e-3, 3e-3}};
  EXPECT_GE(fields_memory(scene) - plain, 4 * 4 * 1e6);  // four grids of floats
}

TEST(FieldMemory, ALargeSphereIsMostlyTiles) {
  voxel::FieldRequest request;
  request.lattice = voxel::cubic_lattice({{0, 0, 0}, {1, 1, 1}}, 1e-3);  // 1e9 cells
  const double cells = cells_reached({0.4}, request);
  EXPECT_LT(cells, 4e7);
  EXPECT_GT(cells, 4 * 3.14 * 400 * 400);  // its surface at the least
}

scene::Scene scene_with(double voxel) {
  scene::Scene scene;
  scene::Field field;
  field.name = "layer";
  field.voxel = voxel;
  field.box = {{0, 0, 0}, {1, 1, 1}};
  scene.fields = {field};
  return scene;
}

TEST(FieldMemory, ARunThatWouldNotFitIsRefusedByItsLargestField) {
  EXPECT_NO_THROW(check_fields_memory(scene_with(1e-2), 1e9));
  try {
    check_fields_memory(scene_with(1e-3), 1e9);
    FAIL() << "12 GB in 1 GB";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("`layer` (1000 x 1000 x 1000 voxels)"), std::string::npos) << message;
    EXPECT_NE(message.find("1 GB free; use a larger voxel"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace interstice::stream
