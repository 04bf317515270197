// Files changed at random, the same way in every run: each must be read or refused, never crash or hang.
#include <sys/resource.h>

#include <algorithm>
#include <random>

#include "reader_testing.h"

namespace interstice::io::testing {
namespace {

using Fuzz = ReaderTest;

constexpr int changed_files = 600;  // per sample; some ten seconds in all

std::string damaged(std::string text, std::mt19937& random) {
  const auto pick = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
  };
  static const std::string likely = "0123456789.eE+- \n\r\t,;:#[]\"ITEMnaxyz<>/=_\0\xff";
  const int edits = 1 + static_cast<int>(pick(4));
  for (int e = 0; e < edits && !text.empty(); ++e) {
    const std::size_t at =
        random() % 2 == 0 ? pick(text.size()) : pick(std::min<std::size_t>(text.size(), 300));
    switch (pick(5)) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = likely[pick(likely.size())];
        break;
      case 2:
        text.erase(at, 1 + pick(30));
        break;
      case 3:
        text.insert(at, text.substr(pick(text.size()), 1 + pick(60)));
        break;
      default:
        text.resize(pick(text.size()));
        break;
    }
  }
  return text;
}

/// No file of these may cost a gigabyte: with less to have, an allocation that follows a damaged count fails.
class MemoryLimit {
 public:
  MemoryLimit() {
    getrlimit(RLIMIT_AS, &before_);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    const rlimit limit{rlim_t{1} << 30, before_.rlim_max};
    setrlimit(RLIMIT_AS, &limit);
#endif
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

class FuzzSample : public ReaderTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("interstice_fuzz_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
};

// Reads all of the file; false where it is refused, in one line.
bool is_read(const std::filesystem::path& path) {
  try {
    for (const auto& frame : read_all(path)) {
      EXPECT_EQ(frame.x.size(), frame.radius.size());
      for (std::size_t k = 0; k < frame.size(); ++k) {
        const bool finite =
            std::isfinite(frame.x[k]) && std::isfinite(frame.y[k]) && std::isfinite(frame.z[k]);
        EXPECT_TRUE(finite && std::isfinite(frame.radius[k]) && frame.radius[k] > 0) << path;
        if (::testing::Test::HasFailure()) return true;
      }
    }
    return true;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return false;
  }
}

TEST_P(FuzzSample, ChangedIsReadOrRefused) {
  const std::string text = slurp(sample(GetParam()));
  const MemoryLimit limit;
  std::mt19937 random(20240229);
  int refused = 0;
  for (int i = 0; i < changed_files && !HasFailure(); ++i) {
    refused += is_read(write(GetParam(), damaged(text, random))) ? 0 : 1;
  }
  EXPECT_GT(refused, changed_files / 10);  // the changes do bite
}

// Cut at each place of its first and last 400 bytes and at every 29th between.
TEST_P(FuzzSample, CutIsReadOrRefused) {
  const std::string text = slurp(sample(GetParam()));
  const MemoryLimit limit;
  for (std::size_t at = 1; at < text.size() && !HasFailure();
       at += at < 400 || at + 400 > text.size() ? 1 : 29) {
    is_read(write(GetParam(), text.substr(0, at)));
  }
}

// Each number of digits in its first 1500 bytes becomes a huge one.
TEST_P(FuzzSample, HugeCountsAreReadOrRefused) {
  const std::string text = slurp(sample(GetParam()));
  const MemoryLimit limit;
  const auto digit = [&](std::size_t at) { return at < text.size() && std::isdigit(text[at]) != 0; };
  for (std::size_t at = 0; at < std::min<std::size_t>(text.size(), 1500) && !HasFailure(); ++at) {
    if (!digit(at) || (at > 0 && digit(at - 1))) continue;
    std::size_t end = at;
    while (digit(end)) ++end;
    for (const char* huge : {"4294967297", "1099511627775", "9223372036854775807", "18446744073709551616"}) {
      is_read(write(GetParam(), text.substr(0, at) + huge + text.substr(end)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, FuzzSample,
                         ::testing::Values("two-frames.dump", "two-frames-gz.dump.gz", "micrometres.csv",
                                           "yade.txt", "pizza.vtk", "binary.vtk", "ascii.vtp", "inline.vtp",
                                           "inline-zlib.vtp", "raw.vtp", "raw-zlib-big-endian.vtp",
                                           "base64.vtp", "base64-zlib.vtp", "mercury.data", "edem.csv"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace interstice::io::testing
