// The figures of a comparison, made up in full before the first is drawn (so that a broken table is found
// before anything is written).
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "coupling/figures/figures.h"
#include "coupling/studies/quantities.h"

namespace interstice::studies {

struct NamedFigure {
  std::string name;  // of the file, without .png
  std::variant<figures::SliceFigure, std::vector<figures::CurveFigure>> figure;
};

using Labels = std::array<std::string, 2>;

/// Where time zero of the figures lies in each run: at the start of a phase that both have where the runs
/// came to it at different times, else at the runs' own zero.
struct TimeZero {
  double a = 0, b = 0;  // [s]
  std::string phase;    // empty: not shifted
  std::string label() const;
};
TimeZero time_zero(const RunFolder& a, const RunFolder& b);

/// Ends of phases: one mark where the runs agree, else one each that says whose it is.
std::vector<figures::CurveFigure::Mark> phase_marks(const RunFolder& a, const RunFolder& b,
                                                    const Labels& labels, const TimeZero& zero);

/// Forces, stresses and the bed's state over time, with the ends of phases.
std::vector<NamedFigure> series_figures(const RunFolder& a, const RunFolder& b, const Labels& labels);

/// Slices at one scale and their difference, lines, profiles at each moment; the layer's numbers over time.
std::vector<NamedFigure> field_figures(const RunFolder& a, const RunFolder& b, const Labels& labels);

}  // namespace interstice::studies
