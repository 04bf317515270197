#include "coupling/io/trajectory_adapter.h"

#include <fmt/format.h>

#include "base/error.h"
#include "coupling/io/columns.h"
#include "coupling/io/trajectory.h"

namespace interstice::io {
namespace {

class TrajectoryAdapter : public ParticleReader {
 public:
  explicit TrajectoryAdapter(std::filesystem::path path) : path_(std::move(path)), trajectory_(path_) {}

  std::string kind() const override { return "H5Part"; }
  std::int64_t frames() const override { return trajectory_.frames(); }

  bool next(ParticleFrame& frame) override {
    if (next_ >= trajectory_.frames()) return false;
    frame = trajectory_.read(next_);
    check(frame);
    sort_by_id(frame);
    check_sizes(frame, path_);
    ++next_;
    return true;
  }

  bool skip() override {
    if (next_ >= trajectory_.frames()) return false;
    ++next_;
    return true;
  }

 private:
  // Text readers check cell by cell; here the columns come whole.
  void check(const ParticleFrame& frame) const {
    const std::size_t n = frame.size();
    if (frame.y.size() != n || frame.z.size() != n || frame.radius.size() != n) {
      throw InputError(
          fmt::format("{}: frame {}: columns x, y, z, radius differ in length; equal ones are needed; "
                      "write the file again",
                      path_.string(), next_));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const bool finite = std::isfinite(frame.x[i]) && std::isfinite(frame.y[i]) && std::isfinite(frame.z[i]);
      if (finite && std::isfinite(frame.radius[i]) && frame.radius[i] > 0) continue;
      const std::string who =
          i < frame.id.size() ? fmt::format("particle {}", frame.id[i]) : fmt::format("row {}", i);
      throw InputError(
          fmt::format("{}: frame {}: {}: position or radius is not finite, or the radius not positive; "
                      "finite numbers only; write the file again",
                      path_.string(), next_, who));
    }
  }

  std::filesystem::path path_;
  TrajectoryReader trajectory_;
  std::int64_t next_ = 0;
};

}  // namespace

std::unique_ptr<ParticleReader> open_trajectory(const std::filesystem::path& path,
                                                const ReaderOptions& options) {
  if (!options.columns.empty()) {
    throw InputError(path.string() +
                     ": --columns does not apply to a trajectory; its datasets have fixed names; leave "
                     "the option out");
  }
  return std::make_unique<TrajectoryAdapter>(path);
}

}  // namespace interstice::io
