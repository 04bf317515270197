// Files of MercuryDPM and EDEM: good ones by hand and from data/samples/make_samples.py, bad ones by one
// change each.
#include <random>

#include "edem_file.h"
#include "reader_testing.h"

namespace interstice::io::testing {
namespace {

using ProgramFiles = ReaderTest;

void expect_error(const std::string& message, const std::string& place, const std::string& what) {
  EXPECT_NE(message.find(place), std::string::npos) << message;
  EXPECT_NE(message.find(what), std::string::npos) << message;
  EXPECT_NE(message.find("; "), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST_F(ProgramFiles, SamplesHoldTheGrainsOfTheDump) {
  const auto dump = read_all(sample("two-frames.dump"));
  for (const char* name : {"mercury.data", "edem.csv"}) {
    const auto frames = read_all(sample(name));
    ASSERT_EQ(frames.size(), 2u) << name;
    for (std::size_t k = 0; k < 2; ++k) {
      ASSERT_EQ(frames[k].size(), 150u);
      EXPECT_EQ(frames[k].time, k == 0 ? 0.25 : 0.5);
      EXPECT_EQ(frames[k].vz, std::vector<double>(150, -0.5));
      for (std::size_t i = 0; i < 150; ++i) {
        EXPECT_NEAR(frames[k].x[i], dump[k].x[i], 1e-15);
        EXPECT_NEAR(frames[k].y[i], dump[k].y[i], 1e-15);
        EXPECT_NEAR(frames[k].z[i], dump[k].z[i], 1e-12);  // nine digits of what the dump has in nine others
        EXPECT_NEAR(frames[k].radius[i], dump[k].radius[i], 1e-13 * k + 1e-19);
      }
    }
  }
}

TEST_F(ProgramFiles, MercuryColumnsAndBounds) {
  const auto path =
      write("a.data.0001", "1 0.5 -1 -2 -3 4 5 6\n0.1 0.2 0.3 1 2 3 0.01 7 8 9 4 5 6 0\n0 1 0 0 0 1 1 1\n");
  EXPECT_EQ(open_particles(path, {})->kind(), "MercuryDPM data");
  const auto frames = read_all(path);
  ASSERT_EQ(frames.size(), 2u);
  const auto& f = frames[0];
  EXPECT_EQ(f.time, 0.5);
  EXPECT_EQ(*f.bounds, (Box{{-1, -2, -3}, {4, 5, 6}}));
  EXPECT_EQ(
      (std::vector<double>{f.x[0], f.y[0], f.z[0], f.vx[0], f.vy[0], f.vz[0], f.radius[0], f.wx[0], f.wz[0]}),
      (std::vector<double>{0.1, 0.2, 0.3, 1, 2, 3, 0.01, 4, 6}));
  EXPECT_EQ(frames[1].size(), 0u);
  const auto reader = open_particles(path, {});
  ParticleFrame frame;
  EXPECT_TRUE(reader->skip());
  EXPECT_TRUE(reader->next(frame));
  EXPECT_EQ(frame.time, 1);
  EXPECT_FALSE(reader->skip());
}

TEST_F(ProgramFiles, MercuryInTwoDimensionsIsReadInAPlaneAndWarnedOf) {
  const auto reader = open_particles(write("a.data", "1 0.5 -1 -2 4 5\n0.1 0.2 1 2 0.01 7 3 0\n"), {});
  ParticleFrame f;
  ASSERT_TRUE(reader->next(f));
  EXPECT_EQ((std::vector<double>{f.x[0], f.y[0], f.z[0], f.vx[0], f.vy[0], f.radius[0], f.wz[0]}),
            (std::vector<double>{0.1, 0.2, 0, 1, 2, 0.01, 3}));
  ASSERT_EQ(reader->warnings().size(), 1u);
}

TEST_F(ProgramFiles, BadMercury) {
  const std::string good = slurp(sample("mercury.data"));
  const auto with = [&](const std::string& from, const std::string& to) {
    return error_of(write("a.data", replaced(good, from, to)));
  };
  expect_error(with("150 0.25", "151 0.25"), "a.data:152: frame 0", "8 values in a row");
  expect_error(with("150 0.25", "149 0.25"), "a.data:151: frame 1", "not a frame's first line");
  expect_error(with("150 0.25", "999999999999 0.25"), "a.data:152: frame 0", "8 values in a row");
  expect_error(with("150 0.5", "150 nan"), "a.data:152: frame 1", "not a frame's first line");
  expect_error(error_of(write("b.data", good.substr(0, good.size() - 300))), "b.data:", "frame 1");
}

const char* const small_edem =
    "EDEM\n\nTIME STEP,0.1\nParticle X Position (mm),Particle Y Position (mm),Particle Z Position (mm),"
    "Particle Diameter (um),Particle Angular Velocity X (rpm)\n1,2,3,40,60\n4,5,6,50,0\n\n"
    "TIME STEP,0.2\n1,2,2.5,40,0\n";

TEST_F(ProgramFiles, EdemUnitsBlocksAndWordOrders) {
  const auto frames = read_all(write("a.csv", small_edem));
  ASSERT_EQ(frames.size(), 2u);
  ASSERT_EQ(frames[0].size(), 2u);
  EXPECT_EQ(frames[0].time, 0.1);
  EXPECT_DOUBLE_EQ(frames[0].y[1], 5e-3);
  EXPECT_DOUBLE_EQ(frames[0].radius[1], 25e-6);
  EXPECT_DOUBLE_EQ(frames[0].wx[0], 2 * 3.14159265358979323846);
  EXPECT_EQ(frames[1].time, 0.2);
  EXPECT_DOUBLE_EQ(frames[1].z[0], 2.5e-3);
}

TEST_F(ProgramFiles, EdemTimeAsAColumn) {
  const auto frames = read_all(
      write("a.csv",
            "Time (s);Particle ID;Position X [m];Position Y [m];Position Z [m];Particle Volume (mm^3)\n"
            "0.1;2;1;2;3;0.004188790204786391\n0.1;1;4;5;6;0.004188790204786391\n0.2;2;1;2;2.5;0."
            "004188790204786391\n"));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].id, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(frames[0].x, (std::vector<double>{4, 1}));
  EXPECT_NEAR(frames[0].radius[0], 1e-4, 1e-18);
  EXPECT_EQ(frames[1].time, 0.2);
}

TEST_F(ProgramFiles, EdemTimeStepWithoutParticles) {
  const std::string names =
      "Particle Position X (m),Particle Position Y (m),Particle Position Z (m),Radius (m)\n";
  const auto frames =
      read_all(write("a.csv", "Time: 0 s\n" + names + "Time: 1 s\n" + names + "1,2,3,0.01\n"));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].size(), 0u);
  EXPECT_EQ(frames[0].time, 0);
  EXPECT_EQ(frames[1].time, 1);
  EXPECT_EQ(frames[1].size(), 1u);
}

TEST_F(ProgramFiles, BadEdem) {
  const auto with = [&](const std::string& from, const std::string& to) {
    return error_of(write("a.csv", replaced(small_edem, from, to)));
  };
  expect_error(with("Diameter (um)", "Diameter (foot)"), "a.csv:4", "unit `foot`");
  expect_error(with("Diameter (um)", "Mass (kg)"), "a.csv:4", "no column `radius` or `diameter`");
  expect_error(with("4,5,6,50,0", "4,5,6,50"), "a.csv:6: frame 0", "4 values in a row");
  expect_error(with("4,5,6,50,0", "4,5,6,0,0"), "a.csv:6: frame 0", "is not positive");
  expect_error(with("4,5,6,50,0", "4,nan,6,50,0"), "a.csv:6: frame 0", "is not finite");
  expect_error(with("4,5,6,50,0", "total,5,6,50,0"), "a.csv:6", "where a row of 5 numbers");
  expect_error(error_of(write("b.csv", std::string(small_edem).substr(0, 20))), "b.csv:", "; ");
}

TEST_F(ProgramFiles, EdemHdf5AsDescribed) {
  EdemFile edem(folder_ / "a.h5");
  edem.fill(true, 2);
  const auto reader = open_particles(edem.path, {});
  EXPECT_EQ(reader->kind(), "EDEM HDF5");
  EXPECT_EQ(reader->frames(), 1);
  ParticleFrame f;
  ASSERT_TRUE(reader->next(f));
  EXPECT_EQ(f.time, 0.125);
  EXPECT_EQ(f.step, 7);
  EXPECT_EQ(f.id, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(f.radius, (std::vector<double>{0.01 * 0.5, 0.02, 0.01 * 2}));
  EXPECT_EQ(f.x, (std::vector<double>{0.4, static_cast<double>(0.7f), 0.1}));
  EXPECT_EQ(f.vz, (std::vector<double>{6, 9, 3}));
  EXPECT_EQ(f.material, (std::vector<std::int32_t>{0, 1, 0}));
  EXPECT_EQ(reader->position_resolution(), 0x1p-24);  // floats below 1 m
  EXPECT_FALSE(reader->next(f));
}

TEST_F(ProgramFiles, BadEdemHdf5) {
  EdemFile bare(folder_ / "a.h5");
  bare.fill(false, 2);
  expect_error(error_of(bare.path), "a.h5: frame 0: not laid out as EDEM's", "no radius of particle type 0");
  EdemFile negative(folder_ / "b.h5");
  negative.fill(true, -2);
  expect_error(error_of(negative.path), "b.h5: frame 0", "scale not positive");
  EdemFile clump(folder_ / "c.h5");
  clump.table("/CreatorData/0/ParticleTypes/1/radius", {0.1, 0.2}, 1, H5T_IEEE_F64LE);
  clump.table("/TimestepData/7/ParticleTypes/1/position", {0.7, 0.8, 0.9}, 3, H5T_IEEE_F64LE);
  clump.file.close("closing");
  expect_error(error_of(clump.path), "c.h5: frame 0", "made of 2 spheres");
  EdemFile shape(folder_ / "d.h5");
  shape.attribute("/CreatorData/0/ParticleTypes/1", "rawRadius", 0.02);
  shape.table("/TimestepData/7/ParticleTypes/1/position", {0.7, 0.8}, 2, H5T_IEEE_F64LE);
  shape.file.close("closing");
  expect_error(error_of(shape.path), "d.h5: frame 0", "has 2 numbers a particle, 3 are due");
  const std::string whole = slurp(folder_ / "a.h5");
  for (const std::size_t part : {9u, 100u, 800u, 2000u}) {
    EXPECT_NE(error_of(write("e.h5", whole.substr(0, part))), "") << part;
  }
}

// Cut at every 7th byte, and with random bytes: read or refused. (What the HDF5 library itself does with its
// own damaged bookkeeping is beyond the reader; see docs/FILES.md, Damage.)
TEST_F(ProgramFiles, DamagedEdemHdf5IsReadOrRefused) {
  EdemFile edem(folder_ / "a.h5");
  edem.fill(true, 2);
  const std::string whole = slurp(edem.path);
  const auto is_read = [&](const std::string& bytes) {
    try {
      for (const auto& f : read_all(write("b.h5", bytes))) {
        for (const double r : f.radius) EXPECT_TRUE(std::isfinite(r) && r > 0);
      }
      return true;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return false;
    }
  };
  for (std::size_t at = 1; at < whole.size(); at += 7) EXPECT_FALSE(is_read(whole.substr(0, at))) << at;
  std::mt19937 random(20240229);
  int refused = 0;
  for (int i = 0; i < 500; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 8; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    refused += is_read(bytes) ? 0 : 1;
  }
  EXPECT_GT(refused, 50);
}

/// The 60 grains of data/samples/programs after `t` seconds of free fall, by the formulas of grains.awk.
ParticleFrame falling(double t) {
  ParticleFrame f;
  for (int i = 0; i < 60; ++i) {
    f.id.push_back(i + 1);
    f.x.push_back(4e-5 + (i % 5) * 6e-5 + (i * 7 % 13) * 5.1234e-7 + 0.01 * t);
    f.y.push_back(4e-5 + (i / 5 % 4) * 6e-5 + (i * 5 % 11) * 5.4321e-7 + 0.005 * t);
    f.z.push_back(4e-5 + (i / 20) * 6e-5 + (i * 3 % 7) * 5.0123e-7 - 0.5 * 9.81 * t * t);
    f.radius.push_back(1e-5 + (i % 11) * 1e-6);
  }
  return f;
}

void expect_grains(const ParticleFrame& frame, double t, double tolerance, const std::string& name) {
  const ParticleFrame expected = falling(t);
  ASSERT_EQ(frame.size(), 60U) << name;
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_NEAR(frame.x[i], expected.x[i], tolerance) << name;
    EXPECT_NEAR(frame.y[i], expected.y[i], tolerance) << name;
    EXPECT_NEAR(frame.z[i], expected.z[i], tolerance) << name;
    EXPECT_NEAR(frame.radius[i], expected.radius[i], 1e-18) << name;  // as written: six digits hold them
  }
}

struct Written {
  const char* name;
  std::size_t frames;
  double start, interval;  // [s]
  double tolerance;        // [m] of positions: what the digits in the file leave
};

// 2,000 steps, each rounding a position of 3e-4 m by half a unit in the last place; 15 digits are finer.
constexpr double kSummed = 2000 * 2.8e-20;

// Files that LIGGGHTS, LAMMPS and YADE wrote themselves.
TEST_F(ProgramFiles, OfTheRealProgramsHoldTheGrainsThatTheyWereGiven) {
  for (const Written& w : {Written{"liggghts.dump", 3, 0, 1e-4, kSummed},
                           {"liggghts-scaled.dump", 2, 0, 2e-4, kSummed},
                           {"liggghts-sixdigits.dump.gz", 3, 0, 1e-4, 5.01e-10},
                           {"liggghts.vtk", 1, 2e-4, 0, 5.01e-10},
                           {"lammps-triclinic.dump", 3, 0, 1e-4, kSummed},
                           {"lammps-triclinic-scaled.dump.gz", 2, 0, 2e-4, kSummed},
                           {"lammps-unwrapped.dump", 2, 0, 2e-4, kSummed},
                           {"yade.txt", 1, 0, 0, 5.01e-10},
                           {"yade-mass.txt", 1, 0, 0, 5.01e-10},
                           {"yade.vtk", 1, 0, 0, 5.01e-10}}) {
    const auto frames = read_all(sample(std::string("programs/") + w.name));
    ASSERT_EQ(frames.size(), w.frames) << w.name;
    for (std::size_t k = 0; k < frames.size(); ++k)
      expect_grains(frames[k], w.start + static_cast<double>(k) * w.interval, w.tolerance, w.name);
  }
}

TEST_F(ProgramFiles, OfTheRealProgramsHaveTheirOtherColumns) {
  const auto liggghts = read_all(sample("programs/liggghts.dump"));
  EXPECT_EQ(liggghts[2].step, 2000);
  EXPECT_EQ(liggghts[2].density, std::vector<double>(60, 7800));
  EXPECT_NEAR(liggghts[2].vz[0], -9.81 * 2e-4, 1e-15);
  const auto lammps = read_all(sample("programs/lammps-triclinic.dump"));
  EXPECT_DOUBLE_EQ(lammps[1].time, 1e-4);  // ITEM: TIME, which dump_modify time yes writes
  EXPECT_EQ(lammps[1].periodic, (std::array<bool, 3>{true, false, false}));
  const auto reader = open_particles(sample("programs/liggghts-sixdigits.dump.gz"), {});
  ParticleFrame frame;
  ASSERT_TRUE(reader->next(frame));
  EXPECT_DOUBLE_EQ(reader->position_resolution(), 1e-9);  // 0.000104000 is told from 0.000104001
}

}  // namespace
}  // namespace interstice::io::testing
