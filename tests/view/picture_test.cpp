#include "weft/picture.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"
#include "weft/core/random.h"
#include "weft/error.h"
#include "weft/files.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

Picture noise(int width, int height) {
  Random random(3);
  Picture picture{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i)
    picture.rgb.push_back(static_cast<std::uint8_t>(random.index(256)));
  return picture;
}

TEST(Picture, PngGivesBackEveryByte) {
  const test::TemporaryFolder folder;
  const Picture written = noise(37, 23);
  write_png(folder / "noise.png", written);
  const Picture read = read_png(folder / "noise.png");
  EXPECT_EQ(read.width, 37);
  EXPECT_EQ(read.height, 23);
  EXPECT_EQ(read.rgb, written.rgb);
}

TEST(Picture, PngThatIsCutShortIsAnInputErrorThatNamesTheFile) {
  const test::TemporaryFolder folder;
  const fs::path whole = folder / "whole.png";
  const fs::path part = folder / "part.png";
  write_png(whole, noise(64, 64));
  const std::string bytes = read_file(whole);
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{7}, std::size_t{40}, bytes.size() / 2}) {
    std::ofstream(part, std::ios::binary) << bytes.substr(0, length);
    try {
      read_png(part);
      FAIL() << "no error at " << length << " bytes";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("part.png"), std::string::npos);
    }
  }
}

TEST(Picture, WritingIntoAMissingFolderIsAnOutputError) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_png(folder / "no/such/folder/a.png", noise(4, 4)), OutputError);
}

TEST(Picture, APictureWhoseBytesDoNotFitItsSizeIsRefused) {
  const test::TemporaryFolder folder;
  Picture picture = noise(4, 4);
  picture.rgb.pop_back();
  EXPECT_THROW(write_png(folder / "short.png", picture), OutputError);
}

}  // namespace
}  // namespace weft
