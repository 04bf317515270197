#include "tests/report/report.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace interstice::testing {
namespace {

/// Tabs and line ends would break the table.
std::string cell(std::string text) {
  for (char& c : text) {
    if (c == '\t' || c == '\n') c = ' ';
  }
  return text;
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

void write_row(const std::string& kind, const std::initializer_list<std::string>& cells) {
  const char* folder = std::getenv("INTERSTICE_REPORT");
  if (!folder) return;
  std::ofstream out(fmt::format("{}/{}.tsv", folder, program_invocation_short_name), std::ios::app);
  out << kind;
  for (const std::string& text : cells) out << '\t' << cell(text);
  out << '\n';
}

void report(const Reference& r, const std::string& quantity, const std::string& expected, double got,
            const std::string& tolerance, bool passed) {
  write_row("check", {r.what, quantity, expected, number(got), tolerance, passed ? "yes" : "NO", r.source});
}

}  // namespace

void expect_close(const Reference& r, const std::string& quantity, double got, double expected,
                  double tolerance) {
  const bool passed = std::fabs(got - expected) <= tolerance;
  EXPECT_NEAR(got, expected, tolerance) << r.what << ": " << quantity;
  report(r, quantity, number(expected), got, fmt::format("±{:.2g}", tolerance), passed);
}

void expect_ratio(const Reference& r, const std::string& quantity, double got, double expected,
                  double tolerance) {
  const bool passed = std::fabs(got / expected - 1) <= tolerance;
  EXPECT_NEAR(got / expected, 1, tolerance) << r.what << ": " << quantity << ", " << got << " for " << expected;
  report(r, quantity, number(expected), got, fmt::format("±{:.2g} %", 100 * tolerance), passed);
}

void expect_between(const Reference& r, const std::string& quantity, double got, double lo, double hi) {
  const bool passed = got >= lo && got <= hi;
  EXPECT_TRUE(passed) << r.what << ": " << quantity << ", " << got << " not in " << lo << " to " << hi;
  report(r, quantity, fmt::format("{} to {}", number(lo), number(hi)), got, "within", passed);
}

void disclose(const Reference& r, const std::string& quantity, double got, double expected,
              const std::string& remark) {
  write_row("check", {r.what, quantity, number(expected), number(got), remark, "shown", r.source});
}

void expect_outcome(const std::string& extreme, const std::string& tried, const std::string& outcome,
                    bool right) {
  EXPECT_TRUE(right) << extreme << ": " << tried << ": " << outcome;
  write_row("extreme", {extreme, tried, outcome, right ? "yes" : "NO"});
}

}  // namespace interstice::testing
