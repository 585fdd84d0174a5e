#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "weft/run.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// A file system with the few files that tell of memory.
class Memory : public ::testing::Test {
 protected:
  void write(const fs::path& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }
  [[nodiscard]] std::optional<std::uint64_t> available() const {
    return available_memory(root_.path());
  }
  void set_available(int kib) {
    write("proc/meminfo",
          "MemTotal: 99999 kB\nMemFree: 10 kB\nMemAvailable: " + std::to_string(kib) + " kB\n");
  }

 private:
  test::TemporaryFolder root_;
};

TEST_F(Memory, UnknownWhereNothingTells) { EXPECT_FALSE(available()); }

TEST_F(Memory, IsWhatTheSystemCallsAvailable) {
  set_available(3000);
  EXPECT_EQ(available(), 3000 * 1024);
}

TEST_F(Memory, LimitOfAnyGroupAboveCounts) {
  set_available(3000);
  write("proc/self/cgroup", "0::/jobs/mine\n");
  write("sys/fs/cgroup/jobs/mine/memory.max", "max\n");
  write("sys/fs/cgroup/jobs/mine/memory.current", "500\n");
  EXPECT_EQ(available(), 3000 * 1024);
  write("sys/fs/cgroup/jobs/memory.max", "2000000\n");
  write("sys/fs/cgroup/jobs/memory.current", "900000\n");
  write("sys/fs/cgroup/jobs/memory.stat", "anon 600000\ninactive_file 300000\n");
  EXPECT_EQ(available(), 2000000 - 600000);
}

TEST_F(Memory, LimitOfTheFirstVersionsGroupCounts) {
  set_available(3000);
  write("proc/self/cgroup", "5:cpu:/\n4:memory:/box\n");
  // In a container the files lie at the top, and the path is the host's.
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "1000000\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1200000\n");
  write("sys/fs/cgroup/memory/memory.stat", "total_inactive_file 0\n");
  EXPECT_EQ(available(), 0);
}

TEST(AvailableMemory, IsKnownHere) {
  const auto here = available_memory();
  ASSERT_TRUE(here);
  EXPECT_GT(*here, 10'000'000);
}

}  // namespace
}  // namespace weft
