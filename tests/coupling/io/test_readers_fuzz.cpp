// Files changed at random, the same way in every run: each must be read or refused, never crash or hang.
#include <algorithm>
#include <random>

#include "reader_testing.h"

namespace interstice::io::testing {
namespace {

using Fuzz = ReaderTest;

constexpr int changed_files = 600;  // per sample; some three seconds in all

std::string damaged(std::string text, std::mt19937& random) {
  const auto pick = [&](std::size_t n) {
    return static_cast<std::size_t>(random() % std::max<std::size_t>(n, 1));
  };
  static const std::string likely = "0123456789.eE+- \n\r\t,;:#[]\"ITEMnaxyz\0\xff";
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

class FuzzSample : public ReaderTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("interstice_fuzz_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
};

TEST_P(FuzzSample, IsReadOrRefused) {
  const std::string text = slurp(sample(GetParam()));
  std::mt19937 random(20240229);
  int read = 0, refused = 0;
  for (int i = 0; i < changed_files; ++i) {
    const auto path = write(GetParam(), damaged(text, random));
    try {
      for (const auto& frame : read_all(path)) {
        ASSERT_EQ(frame.x.size(), frame.radius.size());
        for (std::size_t k = 0; k < frame.size(); ++k) {
          ASSERT_TRUE(std::isfinite(frame.x[k]) && std::isfinite(frame.y[k]) && std::isfinite(frame.z[k]));
          ASSERT_TRUE(std::isfinite(frame.radius[k]) && frame.radius[k] > 0);
        }
      }
      ++read;
    } catch (const InputError& error) {
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_EQ(read + refused, changed_files);
  EXPECT_GT(refused, changed_files / 10);  // the changes do bite
}

INSTANTIATE_TEST_SUITE_P(Samples, FuzzSample,
                         ::testing::Values("two-frames.dump", "two-frames-gz.dump.gz", "micrometres.csv",
                                           "yade.txt"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace interstice::io::testing
