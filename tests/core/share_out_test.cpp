#include "weft/core/share_out.h"

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace weft {
namespace {

struct Heard : Progress {
  std::vector<double> fractions;
  std::vector<std::string> stages;
  std::thread::id teller = std::this_thread::get_id();
  bool only_teller = true;
  void update(std::string_view stage, double fraction) override {
    fractions.push_back(fraction);
    stages.emplace_back(stage);
    only_teller = only_teller && teller == std::this_thread::get_id();
  }
};

TEST(ShareOut, CallsEachOnce) {
  for (const int threads : {1, 2, 3, 40}) {
    std::vector<int> calls(17, 0);
    share_out(17, threads, nullptr, "", [&](int k, Progress*) { ++calls[k]; });
    EXPECT_EQ(calls, std::vector<int>(17, 1));
  }
}

TEST(ShareOut, OfNothingCallsNothing) {
  share_out(0, 3, nullptr, "", [](int, Progress*) { FAIL(); });
}

TEST(ShareOut, ThrowsTheFirstFailureOfAll) {
  for (const int threads : {1, 2, 3, 7}) try {
      share_out(12, threads, nullptr, "", [](int k, Progress*) {
        if (k >= 5) throw std::runtime_error(std::to_string(k));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "5");
    }
}

TEST(ShareOut, TellsProgressOnTheCallersThread) {
  for (const int threads : {1, 3}) {
    Heard heard;
    share_out(9, threads, &heard, "cut", [](int, Progress* own) { update(own, "part", 0.5); });
    ASSERT_FALSE(heard.fractions.empty());
    EXPECT_TRUE(heard.only_teller);
    for (std::size_t k = 0; k < heard.fractions.size(); ++k) {
      EXPECT_EQ(heard.stages[k], "cut");
      EXPECT_GT(heard.fractions[k], k == 0 ? 0 : heard.fractions[k - 1]);
      EXPECT_LT(heard.fractions[k], 1);
    }
  }
}

}  // namespace
}  // namespace weft
