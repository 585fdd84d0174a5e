#include "weft/image/io/image_parts.h"

#include <fstream>

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "tests/support/temporary_folder.h"
#include "weft/error.h"

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

TEST(ImageParts, ArchivesHaveTheLeastByteFirst) {
  const std::string archive = encode_npz_parts({part_of("a", 1, 2)});
  const std::string one{"\0\0\x80\x3f", 4};  // 1.0 in single precision
  EXPECT_EQ(archive.substr(0, 30), std::string("PK\3\4\x14\0\0\x08\0\0\0\0\x21\0", 14) +
                                       archive.substr(14, 4) +
                                       std::string("\x88\0\0\0\x88\0\0\0\5\0\0\0", 12));
  EXPECT_EQ(archive.substr(30 + 5 + 128, 8), one + one);
}

TEST(ImageParts, RefusesNamesThatAnArchiveCannotTell) {
  EXPECT_EQ(test::message_of<OutputError>(
                [] { encode_npz_parts({part_of(std::string(65532, 'a'), 1, 1)}); }),
            "npz: a name of 65532 bytes; at most 65531 are wanted");
  EXPECT_NO_THROW(encode_npz_parts({part_of(std::string(65531, 'a'), 1, 1)}));
}

}  // namespace
}  // namespace weft
