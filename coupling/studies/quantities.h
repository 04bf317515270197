// What is compared between two runs: the rows of comparison.csv.
#pragma once

#include <string>
#include <vector>

#include "coupling/studies/run_folder.h"

namespace interstice::studies {

/// One row. Names are paths from the general to the particular: `spread/substrate/normal_force_N`,
/// `end/layer/solid_fraction_gap`, `end/layer/lines/y@x=0.009,z=3.5e-05/void_fraction_min`.
struct Quantity {
  std::string name;
  double a = 0, b = 0;  // NaN where a run has no such number
  std::string meaning;

  double difference() const { return b - a; }
  double ratio() const;  // b / a; NaN where a is 0
};

/// The same moment of one field in both runs: the last frame of a phase, or the last of all ("end").
struct MomentPair {
  std::string name;
  const FieldMoment* a = nullptr;  // null where the run has none
  const FieldMoment* b = nullptr;
};
std::vector<MomentPair> moment_pairs(const RunFolder& a, const RunFolder& b, const std::string& field);

/// Names of phases (fields, walls): those of A in A's order, then those that only B has.
std::vector<std::string> phases_of_both(const RunFolder& a, const RunFolder& b);
std::vector<std::string> fields_of_both(const RunFolder& a, const RunFolder& b);
std::vector<std::string> walls_of_both(const RunFolder& a, const RunFolder& b);

/// Per sample: total / per, and 0 where nothing touches (per = 0).
std::vector<double> per_unit(const std::vector<double>& total, const std::vector<double>& per);

/// Every row, in order. Reads the line tables of the compared moments; throws InputError where one is broken.
std::vector<Quantity> compare_quantities(const RunFolder& a, const RunFolder& b);

/// comparison.csv: quantity, A, B, B - A, ratio, meaning. An empty cell: the run has no such number.
std::string comparison_csv(const std::vector<Quantity>& quantities);

}  // namespace interstice::studies
