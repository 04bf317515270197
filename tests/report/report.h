// Checks against references that are also reported: each row says what was compared with what, and how near it
// came. With INTERSTICE_REPORT set to a folder, every test program appends its rows there as PROGRAM.tsv, of
// which report_page makes docs/VERIFICATION.md and docs/EXTREMES.md.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace interstice::testing {

/// What is being checked, for the page: "Chung & Ooi test 1: glass", and where the reference comes from.
struct Reference {
  std::string what;
  std::string source;
};

/// |got - expected| <= tolerance (absolute), or the test fails. The row is reported either way.
void expect_close(const Reference& reference, const std::string& quantity, double got, double expected,
                  double tolerance);

/// |got / expected - 1| <= tolerance.
void expect_ratio(const Reference& reference, const std::string& quantity, double got, double expected,
                  double tolerance);

/// lo <= got <= hi.
void expect_between(const Reference& reference, const std::string& quantity, double got, double lo, double hi);

/// A number that is reported beside a reference and not held against it (a disagreement that is disclosed, a
/// curve's point).
void disclose(const Reference& reference, const std::string& quantity, double got, double expected,
              const std::string& remark);

/// A row of the extremes: what was tried, what the program does there, and whether that is as it must be.
void expect_outcome(const std::string& extreme, const std::string& tried, const std::string& outcome, bool right);

}  // namespace interstice::testing
