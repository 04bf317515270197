#include "apps/voids_method.h"

#include <charconv>
#include <cmath>

#include "base/error.h"
#include "coupling/scene/units.h"

namespace interstice::apps {
namespace {

constexpr const char* kMethods =
    "exact, centre, divided, divided:LEAST_VOID (such as divided:0.1), subsample:N (such as subsample:4) or "
    "kernel:LENGTH (such as kernel:60um)";

template <class Number>
bool number(const std::string& text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

void read_subsample(const std::string& text, const std::string& points, MethodOptions& options) {
  if (!number(points, options.subsample) || options.subsample < 1 || options.subsample > 64)
    throw InputError(
        "--method: " + text +
        ": the points per voxel edge are missing or out of range; subsample:1 to subsample:64; write "
        "for example subsample:4");
  options.method = voxel::Method::subsample;
}

void read_divided(const std::string& text, const std::string& least, MethodOptions& options) {
  if (!number(least, options.least_void) || !(options.least_void > 0 && options.least_void < 1))
    throw InputError("--method: " + text +
                     ": the least void fraction is no number between 0 and 1; divided:LEAST_VOID; write for "
                     "example divided:0.1, or divided to delete nothing");
}

void read_kernel(const std::string& text, const std::string& length, MethodOptions& options) {
  options.method = voxel::Method::kernel;
  options.kernel_length = scene::parse_quantity(length, scene::Dimension::length, "--method kernel");
  if (!(options.kernel_length > 0))
    throw InputError("--method: " + text +
                     ": the kernel's length is not positive; lengths above 0; write for example kernel:60um");
}

}  // namespace

void read_method(const std::string& text, MethodOptions& options) {
  const auto colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const bool more = colon != std::string::npos;
  const std::string rest = more ? text.substr(colon + 1) : "";
  if (text == "exact") {
    options.method = voxel::Method::exact;
  } else if (text == "centre" || text == "center") {
    options.method = voxel::Method::centre;
  } else if (name == "subsample") {
    read_subsample(text, rest, options);
  } else if (name == "divided") {
    options.method = voxel::Method::divided;
    if (more) read_divided(text, rest, options);
  } else if (name == "kernel") {
    if (rest.empty())
      throw InputError("--method: " + text +
                       ": the kernel's length is missing; kernel:LENGTH; write for example kernel:60um");
    read_kernel(text, rest, options);
  } else {
    throw InputError("--method: " + text + " is no method; " + kMethods + "; use exact");
  }
}

void read_overlap(const std::string& text, MethodOptions& options) {
  if (text == "union")
    options.overlap = voxel::Overlap::united;
  else if (text != "sum")
    throw InputError("--overlap: " + text + " is not known; sum or union; leave the option out for sum");
}

void read_window(const std::string& text, MethodOptions& options) {
  const auto window = window_named(text);
  if (!window)
    throw InputError("--average-window: " + text +
                     " is no window; box, sphere or gaussian; leave the option out for box");
  if (!(options.average > 0) && !options.scales)
    throw InputError("--average-window: " + text +
                     " has nothing to average; --average LENGTH or --scales beside it; add one of them");
  options.window = *window;
}

void check_together(const MethodOptions& options) {
  if (options.overlap == voxel::Overlap::united && options.method != voxel::Method::exact)
    throw InputError(
        "--overlap: union needs --method exact; the other methods sum over spheres; leave one of the "
        "two out");
}

void apply(const MethodOptions& options, voxel::FieldRequest& request) {
  request.method = options.method;
  request.subsample = options.subsample;
  request.least_void = options.least_void;
  request.kernel_length = options.kernel_length;
  request.overlap = options.overlap;
  request.average_length = options.average;
  request.average_window = options.window;
}

}  // namespace interstice::apps
