// Numbers with units: exact values, and what is refused. Source: the definitions of the units.
#include "coupling/scene/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "coupling/scene/format_quantity.h"
#include "coupling/scene/selectors.h"

namespace interstice::scene {
namespace {

struct Good {
  std::string_view text;
  Dimension dimension;
  double si;
};

TEST(Units, ReadEveryUsualWritingExactly) {
  const double turn = 2 * std::numbers::pi;
  const Good rows[] = {
      {"40 um", Dimension::length, 40e-6},
      {"17um", Dimension::length, 17e-6},
      {"17.3 \xC2\xB5m", Dimension::length, 17.3e-6},
      {"17.3 \xCE\xBCm", Dimension::length, 17.3e-6},
      {"+1.5e-3 mm", Dimension::length, 1.5e-6},
      {"0.1 nm", Dimension::length, 0.1e-9},
      {"2.5 cm", Dimension::length, 2.5e-2},
      {"0 m", Dimension::length, 0},
      {"  .5 m ", Dimension::length, 0.5},
      {"5. m", Dimension::length, 5},
      {"1 mm^2", Dimension::area, 1e-6},
      {"1 mm\xC2\xB3", Dimension::volume, 1e-9},
      {"3ms", Dimension::time, 3e-3},
      {"8 ns", Dimension::time, 8e-9},
      {"2 min", Dimension::time, 120},
      {"1 h", Dimension::time, 3600},
      {"50 Hz", Dimension::frequency, 50},
      {"50 1/s", Dimension::frequency, 50},
      {"0.05 m/s", Dimension::velocity, 0.05},
      {"50 mm/s", Dimension::velocity, 0.05},
      {"50 mm s^-1", Dimension::velocity, 0.05},
      {"-9.81 m/s^2", Dimension::acceleration, -9.81},
      {"-9.81 m/s\xC2\xB2", Dimension::acceleration, -9.81},
      {"1 mg", Dimension::mass, 1e-6},
      {"8200 kg/m^3", Dimension::density, 8200},
      {"8.2 g/cm^3", Dimension::density, 8200},
      {"1 uN", Dimension::force, 1e-6},
      {"1 GPa", Dimension::pressure, 1e9},
      {"1 N/mm^2", Dimension::pressure, 1e6},
      {"1 bar", Dimension::pressure, 1e5},
      {"1 MJ/m^3", Dimension::energy_density, 1e6},
      {"46.4 kJ/m^3", Dimension::energy_density, 46.4e3},
      {"0.1 mJ/m^2", Dimension::surface_energy, 1e-4},
      {"0.1 mN/m", Dimension::surface_energy, 1e-4},
      {"50 erg/cm^2", Dimension::surface_energy, 0.05},
      {"1 kN/m", Dimension::stiffness, 1e3},
      {"2.5 N/mm", Dimension::stiffness, 2500},
      {"1e5 dyn/cm", Dimension::stiffness, 100},
      {"3 mdyn", Dimension::force, 3e-8},
      {"1 nJ", Dimension::energy, 1e-9},
      {"65 zJ", Dimension::energy, 65e-21},
      {"6.5e-20 J", Dimension::energy, 6.5e-20},
      {"0.2 aJ", Dimension::energy, 0.2e-18},
      {"1 eV", Dimension::energy, 1.602176634e-19},
      {"400 meV", Dimension::energy, 0.4 * 1.602176634e-19},
      {"1 erg", Dimension::energy, 1e-7},
      {"1 N\xC2\xB7m", Dimension::energy, 1},
      {"1 N*m", Dimension::energy, 1},
      {"90 deg", Dimension::angle, turn / 4},
      {"200 rpm", Dimension::angular_velocity, 200 * (turn / 60)},
      {"2 rad/s", Dimension::angular_velocity, 2},
      {"0.3", Dimension::dimensionless, 0.3},
      {"35 %", Dimension::dimensionless, 0.35},
      {"35%", Dimension::dimensionless, 0.35},
  };
  for (const Good& row : rows) {
    QuantityProblem problem;
    const auto value = try_parse_quantity(row.text, row.dimension, problem);
    ASSERT_TRUE(value) << row.text << ": " << problem.what;
    const bool decimal = row.dimension != Dimension::angle && row.dimension != Dimension::angular_velocity &&
                         row.text.find("eV") == std::string_view::npos;
    if (decimal)
      EXPECT_EQ(*value, row.si) << row.text;
    else
      EXPECT_DOUBLE_EQ(*value, row.si) << row.text;
  }
}

struct Bad {
  std::string_view text;
  Dimension dimension;
  std::string_view fragment;
};

TEST(Units, RefuseWithTheUnitThatIsDue) {
  const Bad rows[] = {
      {"17", Dimension::length, "17 has no unit; a length is due (SI: m); write \"17 m\" if it is in SI"},
      {"0", Dimension::length, "has no unit"},
      {"17 ms", Dimension::length, "\"ms\" is the unit of a time; a length is due (SI: m)"},
      {"8200 kg", Dimension::density, "is the unit of a mass; a density is due (SI: kg/m^3)"},
      {"1 MJ/m^2", Dimension::energy_density, "is the unit of a surface energy"},
      {"1 kPa", Dimension::stiffness, "is the unit of a pressure; a stiffness is due (SI: N/m)"},
      {"1 N", Dimension::energy,
       "is the unit of a force; an energy is due (SI: J); write for instance \"65 zJ\""},
      {"50 Hz", Dimension::angular_velocity, "is the unit of a frequency"},
      {"5 m", Dimension::dimensionless, "is the unit of a length; a plain number or a percentage is due"},
      {"17 parsec", Dimension::length, "\"parsec\" is not a unit"},
      {"17 Um", Dimension::length, "is not a unit"},
      {"17 m/", Dimension::length, "is not a unit"},
      {"17 m^", Dimension::length, "is not a unit"},
      {"17 m^x", Dimension::length, "is not a unit"},
      {"17 /s", Dimension::frequency, "is not a unit"},
      {"17 m^0", Dimension::length, "is not a unit"},
      {"0.3 1", Dimension::dimensionless, "is not a unit"},
      {"1,5 mm", Dimension::length, "is not a unit"},
      {"5 - 65 um", Dimension::length, "is not a unit"},
      {"um", Dimension::length, "does not start with a finite decimal number"},
      {"", Dimension::length, "does not start with a finite decimal number"},
      {"nan m", Dimension::length, "does not start with a finite decimal number"},
      {"inf m", Dimension::length, "does not start with a finite decimal number"},
      {"1e400 m", Dimension::length, "too large or too small"},
      {"1e308 km", Dimension::length, "too large or too small"},
      {"1e99999999999999999999 m", Dimension::length, "too large or too small"},
      {"1e-400 m", Dimension::length, "too large or too small"},
      {"0x10 m", Dimension::length, "is not a unit"},
  };
  for (const Bad& row : rows) {
    try {
      parse_quantity(row.text, row.dimension, "--voxel");
      ADD_FAILURE() << row.text << " was accepted";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(row.fragment), std::string::npos) << message;
      EXPECT_EQ(message.rfind("--voxel: ", 0), 0u) << message;
    }
  }
}

TEST(Units, WrittenExactlyTheyReadBackAsTheSameBits) {
  QuantityProblem problem;
  for (double value :
       {1.73e-5, 0.1, 1.0 / 3, 6.999999999999997e-05, -0.0, 5e-324, 1.7976931348623157e308, 1e22, 8200.0})
    for (const Dimension dimension : {Dimension::length, Dimension::density, Dimension::acceleration}) {
      const auto back = try_parse_quantity(format_exact(value, dimension), dimension, problem);
      ASSERT_TRUE(back) << format_exact(value, dimension);
      EXPECT_EQ(*back, value);
      EXPECT_EQ(std::signbit(*back), std::signbit(value));
    }
}

TEST(Units, WrittenForPeopleWithAHandyPrefix) {
  EXPECT_EQ(format_length(17.3e-6), "17.3 um");
  EXPECT_EQ(format_length(0), "0 m");
  EXPECT_EQ(format_length(-0.75e-3), "-750 um");
  EXPECT_EQ(format_length(18e-3), "18 mm");
  EXPECT_EQ(format_length(0.99999e-6), "1 um");
  EXPECT_EQ(format_length(1234), "1234 m");
  EXPECT_EQ(format_time(3e-3), "3 ms");
  EXPECT_EQ(format_time(8e-9), "8 ns");
  EXPECT_EQ(format_quantity(0.05, Dimension::velocity), "50 mm/s");
  EXPECT_EQ(format_quantity(1e9, Dimension::pressure), "1 GPa");
  EXPECT_EQ(format_quantity(8200, Dimension::density), "8200 kg/m^3");
  EXPECT_EQ(format_quantity(12e3, Dimension::stiffness), "12 kN/m");
  EXPECT_EQ(format_quantity(6.5e-20, Dimension::energy), "6.5e-20 J");
  EXPECT_EQ(format_quantity(0.35, Dimension::dimensionless), "0.35");
}

TEST(Selectors, ReadBoxesSlicesAndLines) {
  const Box box = parse_box("0 mm,18mm, -0.75 mm,0.75 mm,0 m,100 um", "--box");
  EXPECT_EQ(box, (Box{{0, -0.75e-3, 0}, {18e-3, 0.75e-3, 100e-6}}));
  EXPECT_EQ(parse_slice("x=4.5mm", "--slice"), (Slice{0, 4.5e-3}));
  EXPECT_EQ(parse_slice(" z = 35 um", "--slice"), (Slice{2, 35e-6}));
  EXPECT_EQ(parse_line("y@x=9mm,z=35um", "--line"), (Line{1, {9e-3, 0, 35e-6}}));
  EXPECT_EQ(parse_line("z @ y=-1 um, x=2 um", "--line"), (Line{2, {2e-6, -1e-6, 0}}));
  EXPECT_EQ(parse_layers("0 um,70um, 40,10", "--layers"), (FieldLayers{0, 70e-6, {40, 10}}));
  EXPECT_EQ(parse_length_unit("um", "--length-unit"), 1e-6);
}

TEST(Selectors, RefuseWhatIsMalformed) {
  for (const std::string_view text : {"0mm,1mm", "0,1,0,1,0,1", "1mm,0mm,0mm,1mm,0mm,1mm",
                                      "0mm,0mm,0mm,1mm,0mm,1mm", "0mm,1mm,0mm,1mm,0mm,1mm,2mm", ""})
    EXPECT_THROW(parse_box(text, "--box"), InputError) << text;
  for (const std::string_view text :
       {"x", "x=", "x=4.5", "w=1mm", "x=1mm=2mm", "=1mm", "x=3ms", "xy=1mm", ""})
    EXPECT_THROW(parse_slice(text, "--slice"), InputError) << text;
  for (const std::string_view text : {"y", "y@", "y@x=1mm", "y@x=1mm,y=2mm", "y@x=1mm,x=2mm", "y@x=1,z=2",
                                      "y@@x=1mm,z=1mm", "w@x=1mm,z=2mm", "y@x=1mm,z=1mm,z=2mm", ""})
    EXPECT_THROW(parse_line(text, "--line"), InputError) << text;
  for (const std::string_view text :
       {"", "0,70,40,10", "0um,70um,40", "70um,0um,40,10", "0um,70um,0,10", "0um,70um,4.5,10",
        "0um,70um,40,10,1", "0um,70um,999999,1", "0um,70um,99999999999,1"})
    EXPECT_THROW(parse_layers(text, "--layers"), InputError) << text;
  for (const std::string_view text : {"", "ms", "5 um"})
    EXPECT_THROW(parse_length_unit(text, "--length-unit"), InputError) << text;
}

}  // namespace
}  // namespace interstice::scene
