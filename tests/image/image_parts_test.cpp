#include "weft/image/io/image_parts.h"

#include <fstream>

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace weft {
namespace {

ImagePart part_of(const std::string& name, int rows, int cols) {
  return {name, rows, cols, {{"R", std::vector<float>(static_cast<std::size_t>(rows) * cols, 1)}}};
}

TEST(ImageParts, MayDifferInSize) {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "parts.exr").string();
  std::ofstream(path, std::ios::binary) << encode_exr_parts(
      {part_of("sleeve", 5, 9), part_of("waistband", 5, 73), part_of("front", 33, 17)});
  Imf::MultiPartInputFile file(path.c_str());
  ASSERT_EQ(file.parts(), 3);
  EXPECT_EQ(file.header(1).dataWindow().max.x, 72);
  EXPECT_EQ(file.header(1).dataWindow().max.y, 4);
  EXPECT_EQ(file.header(2).dataWindow().max.y, 32);
}

}  // namespace
}  // namespace weft
