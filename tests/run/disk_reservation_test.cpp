#include "weft/run/disk_reservation.h"

#include <csignal>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"

namespace weft {
namespace {

TEST(DiskReservation, IsTakenAndGivenBack) {
  const test::TemporaryFolder place;
  {
    const DiskReservation held(place / "room", 100'000);
    EXPECT_EQ(std::filesystem::file_size(place / ".room.part"), 100'000);
  }
  EXPECT_EQ(place.entries(), 0);
}

TEST(DiskReservation, MoreThanThereIsIsAnErrorThatLeavesNothing) {
  const test::TemporaryFolder place;
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit small{1000, old.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message =
      test::message_of<OutputError>([&] { const DiskReservation held(place / "room", 100'000); });
  setrlimit(RLIMIT_FSIZE, &old);
  (void)std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(message.find("no room to report in: "), std::string::npos) << message;
  EXPECT_EQ(place.entries(), 0);
}

}  // namespace
}  // namespace weft
