// A progress bar with rate and time left on a terminal, a plain line now and then elsewhere; always on
// stderr.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "coupling/stream/run.h"

namespace interstice::apps {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

  void show(const stream::Progress& p) {
    const double share = p.end > 0 ? std::min(1.0, p.time / p.end) : 0;
    show(share,
         fmt::format("{}  t = {:.4g} of {:.4g} ms  {} grains  {:.2f} M particle-steps/s  {} left", p.phase,
                     p.time * 1e3, p.end * 1e3, p.grains, p.rate / 1e6, duration(p.seconds_left)));
  }

  void show(double share, const std::string& what) {
    if (quiet_) return;
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ && shown_ && now - last_ < std::chrono::seconds(10)) return;
    last_ = now;
    shown_ = true;
    const std::string text = fmt::format("{:3.0f} %  {}", 100 * share, what);
    if (terminal_) {
      const int filled = static_cast<int>(20 * share);
      fmt::print(stderr, "\r\033[K[{}{}] {}", std::string(filled, '#'), std::string(20 - filled, '.'), text);
      std::fflush(stderr);
      open_ = true;
    } else {
      fmt::print(stderr, "{}\n", text);
    }
  }

  /// A line of its own, such as a warning.
  void line(const std::string& text) {
    clear();
    fmt::print(stderr, "{}\n", text);
  }

  void clear() {
    if (open_) fmt::print(stderr, "\r\033[K");
    open_ = false;
  }

  static std::string duration(double seconds) {
    if (seconds < 90) return fmt::format("{:.0f} s", seconds);
    if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
    if (seconds < 172800) return fmt::format("{:.1f} h", seconds / 3600);
    return fmt::format("{:.1f} days", seconds / 86400);
  }

 private:
  bool quiet_, terminal_, open_ = false, shown_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace interstice::apps
