// Tables of particles in text: which column is what, and how a row becomes an entry of a frame.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/io/particle_frame.h"
#include "coupling/io/text_lines.h"
#include "coupling/io/written_digits.h"

namespace interstice::io {

enum class Quantity {
  none,
  id,
  x,
  y,
  z,
  radius,
  diameter,
  volume,
  vx,
  vy,
  vz,
  wx,
  wy,
  wz,
  density,
  material,
  layer,
  bonded,
  coordination,
  stress_xx,
  stress_yy,
  stress_zz,
  stress_xy,
  stress_yz,
  stress_xz,
  time
};

/// The names that `quantity` may have in a kind of file, the preferred first.
struct ColumnNames {
  Quantity quantity;
  std::string ours;  // the name that --columns uses
  std::vector<std::string> names;
};

/// `names` and those of the columns that only quantities of fields need, called the same in every kind.
std::vector<ColumnNames> with_field_columns(std::vector<ColumnNames> names);

/// One entry per column of the file.
struct ColumnMap {
  struct Column {
    Quantity quantity = Quantity::none;
    std::string name;   // as the file has it
    double factor = 1;  // to SI
  };
  std::vector<Column> columns;

  const Column* find(Quantity quantity) const;
};

/// How the cells of a row are told apart: by blanks, or by one character.
struct Separator {
  char character = ' ';
  bool blanks() const { return character == ' '; }
};

std::vector<std::string_view> split(std::string_view line, Separator separator);

/// Finds the quantities among the columns `present`. `given` (--columns) comes before `known`. Throws
/// InputError at `where` when x, y, z or a size is missing, or a name fits two columns.
ColumnMap map_columns(const std::vector<std::string>& present, const std::vector<ColumnNames>& known,
                      const std::map<std::string, std::string>& given, const std::string& where);

/// Where in a file we are. The text is made only for a message: rows are many.
struct Place {
  const TextLines& lines;
  std::int64_t frame = -1;  // -1: the kind has one frame only
  std::string text() const;
};

/// Appends one row to `frame` (a diameter goes to `radius` halved, a volume as that of a sphere; a time is
/// passed over), its positions also to `digits`. Throws InputError at `place` for a cell
/// that is no finite number, a size that is not positive, or a row with more or fewer cells than columns.
void append_row(std::string_view line, Separator separator, const ColumnMap& map, const Place& place,
                ParticleFrame& frame, WrittenDigits* digits = nullptr);

/// A number in full: no blanks, no rest. Infinities and NaN parse; false only for what is no number.
bool parse_number(std::string_view text, double& value);
bool parse_number(std::string_view text, std::int64_t& value);

/// What kind of thing a quantity is.
bool is_length(Quantity quantity);
bool is_velocity(Quantity quantity);
bool is_spin(Quantity quantity);
bool is_size(Quantity quantity);
bool is_stress(Quantity quantity);

/// Where `frame` keeps a real quantity; nullptr for the others (whole numbers, id, time, none).
std::vector<double>* real_column(ParticleFrame& frame, Quantity quantity);

/// Where `frame` keeps a whole number (material, layer, bonded); nullptr for the others.
std::vector<std::int32_t>* whole_column(ParticleFrame& frame, Quantity quantity);

/// The radius that a size (a radius, a diameter or a volume) stands for.
double radius_of(Quantity quantity, double size);

/// Text of a file for a message: cut and without control characters, so that a binary file does not fill the
/// screen.
std::string shown(std::string_view text);

/// Sorts all columns by id. Returns the number of ids that occur more than once.
std::int64_t sort_by_id(ParticleFrame& frame);

/// "a, b, c".
std::string list_of(const std::vector<std::string>& names);

}  // namespace interstice::io
