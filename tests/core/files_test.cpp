#include "weft/files.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/support/temporary_folder.h"
#include "weft/error.h"

namespace weft {
namespace {
namespace fs = std::filesystem;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::input);
    return error.what();
  }
  return "no error";
}

TEST(Files, WrittenFileReadsBackTheSame) {
  const test::TemporaryFolder folder;
  const std::string bytes("a\0b\n\xff", 5);
  write_file(folder / "f.bin", [&](std::ostream& out) { out << bytes; });
  EXPECT_EQ(read_file(folder / "f.bin"), bytes);
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Files, FailedWriteLeavesTheOldFileAndNothingElse) {
  const test::TemporaryFolder folder;
  write_file(folder / "f.txt", [](std::ostream& out) { out << "old"; });
  EXPECT_THROW(write_file(folder / "f.txt",
                          [](std::ostream& out) {
                            out << "half";
                            throw Interrupted();
                          }),
               Interrupted);
  EXPECT_EQ(read_file(folder / "f.txt"), "old");
  EXPECT_EQ(folder.entries(), 1);
}

TEST(Files, LinksStayAndLeadToWhatWasWritten) {
  const test::TemporaryFolder folder;
  make_folder(folder / "there");
  fs::create_symlink("there/f.txt", folder / "near.txt");
  fs::create_symlink(folder / "near.txt", folder / "far.txt");
  for (const char* text : {"new", "newer"}) {  // to no file yet, and to one
    write_file(folder / "far.txt", [&](std::ostream& out) { out << text; });
    EXPECT_TRUE(fs::is_symlink(folder / "far.txt"));
    EXPECT_EQ(read_file(folder / "there/f.txt"), text);
  }
  fs::create_symlink("round.txt", folder / "round.txt");
  write_file(folder / "round.txt", [](std::ostream& out) { out << "end"; });
  EXPECT_EQ(read_file(folder / "round.txt"), "end");
}

TEST(Files, FullDiskIsAnErrorAndLeavesNothing) {
  const test::TemporaryFolder folder;
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit small{4096, old.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of([&] {
    write_file(folder / "big.bin", [](std::ostream& out) { out << std::string(100000, 'x'); });
  });
  setrlimit(RLIMIT_FSIZE, &old);
  (void)std::signal(SIGXFSZ, old_handler);
  EXPECT_NE(message.find("big.bin: cannot be written"), std::string::npos) << message;
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Files, ErrorsNameThePathAndTheReason) {
  const test::TemporaryFolder folder;
  const auto read = [](const fs::path& path) { return message_of([&] { (void)read_file(path); }); };
  const auto write = [](const fs::path& path) {
    return message_of([&] { write_file(path, [](std::ostream&) {}); });
  };
  EXPECT_NE(read(folder / "none").find("none: cannot be opened: No such file"), std::string::npos);
  EXPECT_NE(read(folder.path()).find("is a folder"), std::string::npos);
  // The first page of memory, which nothing is mapped to.
  EXPECT_NE(read("/proc/self/mem").find("mem: cannot be read: "), std::string::npos);
  EXPECT_NE(write(folder / "no/f").find("cannot be written: No such file"), std::string::npos);
  EXPECT_NE(write(folder.path()).find("is a folder"), std::string::npos);
}

TEST(WantedFolder, EmptyOnesThatItMadeGoAgain) {
  const test::TemporaryFolder place;
  { const WantedFolder folder(place / "a/b/c"); }
  EXPECT_EQ(place.entries(), 0);
  { const WantedFolder folder(place / "a/b/"); }
  EXPECT_EQ(place.entries(), 0);
  make_folder(place / "mine");
  { const WantedFolder folder(place / "mine/b"); }
  EXPECT_TRUE(std::filesystem::is_empty(place / "mine"));
  { const WantedFolder folder(place / "mine"); }
  EXPECT_TRUE(std::filesystem::exists(place / "mine"));
}

TEST(WantedFolder, OnesThatHoldSomethingStay) {
  const test::TemporaryFolder place;
  {
    const WantedFolder folder(place / "a/b");
    write_file(place / "a/file", [](std::ostream& out) { out << "whole"; });
  }
  EXPECT_TRUE(std::filesystem::exists(place / "a/file"));
  EXPECT_FALSE(std::filesystem::exists(place / "a/b"));
}

}  // namespace
}  // namespace weft
