#include "weft/core/thread_team.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "weft/core/ordered_sum.h"
#include "weft/core/random.h"

namespace weft {
namespace {

constexpr std::array team_sizes{1, 2, 3, 7};

TEST(ThreadTeam, SharesCoverEveryIndexOnce) {
  for (const int size : team_sizes) {
    ThreadTeam team(size);
    std::vector<int> touched(1001, 0);
    team.run([&](Worker& worker) {
      const Range mine = worker.share(1001);
      for (int i = mine.first; i < mine.last; ++i) ++touched[i];
    });
    EXPECT_EQ(std::accumulate(touched.begin(), touched.end(), 0), 1001) << size;
    EXPECT_EQ(*std::max_element(touched.begin(), touched.end()), 1) << size;
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Without room for their stacks threads cannot be started.
TEST(ThreadTeam, IsSmallerWhereTheSystemHasNoMoreThreads) {
  const auto work_in_small_memory = [] {
    const rlimit most{std::size_t{1} << 28, std::size_t{1} << 28};
    if (setrlimit(RLIMIT_AS, &most) != 0) std::exit(1);
    ThreadTeam team(1000);
    std::atomic<int> workers = 0;
    team.run([&](Worker&) { ++workers; });
    std::exit(team.size() < 1000 && workers == team.size() ? 7 : 2);
  };
  EXPECT_EXIT(work_in_small_memory(), testing::ExitedWithCode(7), "");
}
#endif

#if !defined(__SANITIZE_THREAD__)  // which lets no child of a fork start threads
/// Whether a region came that the workers shared, as not every one does on a crowded machine.
bool work_together(ThreadTeam& team) {
  for (int region = 0; region < 10'000; ++region) {
    std::atomic<int> workers = 0;
    int wanted = 0;
    team.run([&](Worker& worker) {
      ++workers;
      if (worker.rank() == 0) wanted = worker.size();
      worker.barrier();
    });
    if (workers != wanted) return false;
    if (wanted == team.size()) return true;
  }
  return false;
}

/// Ends a child of a fork, with 7 where all went well and nobody was waited for.
[[noreturn]] void end_child(ThreadTeam& team, bool works) {
  alarm(60);
  const bool well = !works || (work_together(team) && work_together(team));
  team.~ThreadTeam();
  _exit(well ? 7 : 1);
}

int exit_code(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ThreadTeam, ChildrenOfForksHaveWorkersOfTheirOwn) {
  ThreadTeam team(3);
  for (const int sleep : {0, 20}) {  // workers spin, or are asleep
    for (const bool works : {true, false}) {
      work_together(team);
      std::this_thread::sleep_for(std::chrono::milliseconds(sleep));
      const pid_t child = fork();
      if (child == 0) end_child(team, works);
      EXPECT_EQ(exit_code(child), 7) << sleep << works;
    }
  }
}
#endif

TEST(ThreadTeam, BarrierMakesEarlierWritesVisible) {
  for (const int size : team_sizes) {
    ThreadTeam team(size);
    std::vector<int> values(64, 0), neighbours(64, 0);
    team.run([&](Worker& worker) {
      const Range mine = worker.share(64);
      for (int round = 1; round <= 50; ++round) {
        for (int i = mine.first; i < mine.last; ++i) values[i] = round * (i + 1);
        worker.barrier();
        for (int i = mine.first; i < mine.last; ++i) neighbours[i] = values[(i + 17) % 64];
        worker.barrier();
        for (int i = mine.first; i < mine.last; ++i)
          if (neighbours[i] != round * ((i + 17) % 64 + 1)) values[i] = -1;
      }
    });
    for (const int value : values) EXPECT_GT(value, 0) << size;
  }
}

TEST(ThreadTeam, RunsManyRegionsInTurn) {
  ThreadTeam team(3);
  std::array<int, 3> counts{};
  for (int i = 0; i < 2000; ++i)
    team.run([&](Worker& worker) {
      const Range mine = worker.share(3);
      for (int part = mine.first; part < mine.last; ++part) ++counts[part];
    });
  EXPECT_EQ(counts, (std::array{2000, 2000, 2000}));
}

TEST(ThreadTeam, WorkersThatFellAsleepJoinTheNextRegion) {
  ThreadTeam team(3);
  std::array<int, 3> counts{};
  for (int i = 0; i < 20; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(i % 3));
    team.run([&](Worker& worker) {
      const Range mine = worker.share(3);
      for (int part = mine.first; part < mine.last; ++part) ++counts[part];
    });
  }
  EXPECT_EQ(counts, (std::array{20, 20, 20}));
}

TEST(ThreadTeam, WorkThatIsNotWorthSharingIsTheCallersAlone) {
  ThreadTeam team(3);
  int calls = 0, workers = 0;
  team.run_if(false, [&](Worker& worker) {
    ++calls;
    workers = worker.size();
  });
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(workers, 1);
}

TEST(ThreadTeam, CallerGoesAloneForAWhileWhereOthersKeepItWaiting) {
  ThreadTeam team(2);
  RowSums sums(10);
  const auto crowded = [](Worker& worker) {
    if (worker.rank() == 1) std::this_thread::sleep_for(std::chrono::milliseconds(30));
    worker.barrier();
  };
  const auto is_alone = [&] {
    bool alone = false;
    team.run([&](Worker& worker) {
      const double sum = sums.sum(worker, [](int r) { return r + 1.0; });
      EXPECT_EQ(sum, 55);
      if (worker.rank() == 0) alone = worker.alone();
    });
    return alone;
  };
  team.run(crowded);
  EXPECT_TRUE(is_alone());
  bool together = false;
  for (int i = 0; i < 10'000 && !together; ++i) together = !is_alone();
  EXPECT_TRUE(together);
}

TEST(OrderedSum, GivesTheSameBitsForAnyTeam) {
  constexpr int rows = 37, cols = 501;
  Random random(7);
  std::vector<double> values(rows * cols);
  for (double& value : values) value = random.uniform(-1, 1) * (random.index(5) == 0 ? 1e12 : 1e-6);
  std::vector<double> totals;
  for (const int size : team_sizes) {
    ThreadTeam team(size);
    RowSums sums(rows);
    double total = 0;
    team.run([&](Worker& worker) {
      const auto row_sum = [&](int r) {
        return lane_sum(cols, [&](int c) { return values[r * cols + c]; });
      };
      double mine = 0;
      for (int repeat = 0; repeat < 20; ++repeat) mine = sums.sum(worker, row_sum);
      if (worker.rank() == 0) total = mine;
    });
    totals.push_back(total);
  }
  for (const double total : totals) EXPECT_EQ(total, totals.front());
}

TEST(OrderedSum, LaneSumAddsEveryTermOnce) {
  for (int count = 0; count < 40; ++count)
    EXPECT_EQ(lane_sum(count, [](int i) { return i + 1.0; }), count * (count + 1) / 2.0);
}

}  // namespace
}  // namespace weft
