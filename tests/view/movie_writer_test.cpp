#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "weft/error.h"
#include "weft/picture.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// What a command prints, without its last line break.
std::string output_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 256> part{};
  while (pipe != nullptr && std::fgets(part.data(), part.size(), pipe) != nullptr)
    text += part.data();
  if (pipe != nullptr) ::pclose(pipe);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

class Movie : public testing::Test {
 protected:
  void SetUp() override {
    if (output_of("ffprobe -version 2>&1").rfind("ffprobe version", 0) != 0)
      GTEST_SKIP() << "ffmpeg and ffprobe are not installed: movies are NOT tested";
  }
  static Picture frame(int width, int height, int index) {
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (const int channel : {x * 3, y * 5, index * 16})
          picture.rgb.push_back(static_cast<std::uint8_t>(channel % 256));
    return picture;
  }
  static std::string probed(const fs::path& path) {
    return output_of(
        "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
        "stream=codec_name,width,height,nb_read_frames -of csv=p=0 '" +
        path.string() + "'");
  }
  test::TemporaryFolder folder_;
};

TEST_F(Movie, Mp4HoldsEveryFrame) {
  MovieWriter writer(folder_ / "a.mp4", 66, 50, 30);
  for (int i = 0; i < 12; ++i) writer.add(frame(66, 50, i));
  EXPECT_FALSE(fs::exists(folder_ / "a.mp4"));
  writer.finish();
  EXPECT_EQ(probed(folder_ / "a.mp4"), "h264,66,50,12");
  EXPECT_EQ(folder_.entries(), 1);
}

TEST_F(Movie, GifHoldsEveryFrame) {
  MovieWriter writer(folder_ / "a.GIF", 64, 48, 25);
  for (int i = 0; i < 7; ++i) writer.add(frame(64, 48, i));
  writer.finish();
  EXPECT_EQ(probed(folder_ / "a.GIF"), "gif,64,48,7");
}

TEST_F(Movie, OddSizesAreWholeInAGifAndRefusedInAnMp4) {
  MovieWriter writer(folder_ / "a.gif", 65, 49, 25);
  writer.add(frame(65, 49, 0));
  writer.finish();
  EXPECT_EQ(probed(folder_ / "a.gif"), "gif,65,49,1");
  EXPECT_THROW(MovieWriter(folder_ / "a.mp4", 65, 48, 30), OutputError);
  EXPECT_THROW(MovieWriter(folder_ / "a.mp4", 64, 49, 30), OutputError);
  EXPECT_EQ(folder_.entries(), 1);
}

TEST_F(Movie, GivenUpLeavesNothingBehind) {
  {
    MovieWriter writer(folder_ / "a.mp4", 64, 48, 30);
    for (int i = 0; i < 3; ++i) writer.add(frame(64, 48, i));
  }
  EXPECT_EQ(folder_.entries(), 0);
}

TEST_F(Movie, WithoutAFrameIsAnOutputErrorThatNamesTheMovie) {
  MovieWriter writer(folder_ / "empty.mp4", 64, 48, 30);
  try {
    writer.finish();
    FAIL() << "an empty movie was accepted";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("empty.mp4"), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(folder_ / "empty.mp4"));
}

TEST_F(Movie, PlacesAndEndingsThatCannotBeAreOutputErrors) {
  EXPECT_THROW(MovieWriter(folder_ / "missing/a.mp4", 64, 48, 30), OutputError);
  EXPECT_THROW(MovieWriter(folder_ / "a.avi", 64, 48, 30), OutputError);
  EXPECT_THROW(MovieWriter(folder_ / "a.mp4", 64, 48, 0), OutputError);
  MovieWriter writer(folder_ / "a.mp4", 64, 48, 30);
  EXPECT_THROW(writer.add(frame(32, 48, 0)), OutputError);
}

TEST(MovieWithoutFfmpeg, IsAnOutputErrorThatSaysSo) {
  const test::TemporaryFolder folder;
  const std::string path = ::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  std::string said;
  try {
    MovieWriter writer(folder / "b.mp4", 64, 48, 30);
  } catch (const OutputError& error) {
    said = error.what();
  }
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_NE(said.find("ffmpeg"), std::string::npos) << said;
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace weft
