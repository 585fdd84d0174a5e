#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/image/image_cases.h"
#include "tests/support/errors.h"
#include "weft/core/random.h"
#include "weft/image/io/exr_codec.h"
#include "weft/image/io/exr_header.h"
#include "weft/image/io/metadata.h"
#include "weft/image/io/png_codec.h"

namespace weft {
namespace {

using test::expect_same_metadata;
using test::expect_same_samples;
using test::refusal_of_bytes;
using test::torus_image;

/// The bytes of an EXR file's attribute, to change.
std::string_view attribute_of(std::string_view bytes, const std::string& name,
                              const std::string& type) {
  const std::string head = name + '\0' + type + '\0';
  const std::size_t at = bytes.find(head) + head.size();
  return bytes.substr(at + 4, static_cast<unsigned char>(bytes[at]));
}

TEST(DamagedImage, FileCutShortAnywhereIsRefused) {
  for (const std::string& whole : {exr_bytes(torus_image(7)), png_bytes(torus_image(7))}) {
    EXPECT_EQ(refusal_of_bytes(whole), std::nullopt);
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_TRUE(refusal_of_bytes(whole.substr(0, size)).has_value()) << "cut to " << size;
  }
}

TEST(DamagedImage, FlippedBitsAreRefusedOrHarmless) {
  Random random(11);
  for (const std::string& whole : {exr_bytes(torus_image(7)), png_bytes(torus_image(7))}) {
    const GeometryImage image = parse_image(whole, "whole");
    int refused = 0;
    for (std::size_t at = 0; at < whole.size(); ++at) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << random.index(8)));
      if (refusal_of_bytes(damaged)) {
        ++refused;
        continue;
      }
      const GeometryImage survivor = parse_image(damaged, "damaged");
      expect_same_samples(image, survivor);
      expect_same_metadata(image, survivor);
    }
    EXPECT_GT(refused, static_cast<int>(whole.size()) / 2);
  }
}

TEST(DamagedImage, ExrThatTellsOfMoreThanItHoldsIsRefusedAtItsHeader) {
  const GeometryImage image = torus_image(7);
  const auto told = [&](unsigned char low, unsigned char high) {
    std::string bytes = encode_exr(image.cube, metadata_text(image));
    const std::size_t right =
        bytes.find("dataWindow") + std::string("dataWindow.box2i.").size() + 12;
    for (const std::size_t place : {right, right + 4}) {  // right and bottom, little-endian
      bytes[place] = static_cast<char>(low);
      bytes[place + 1] = static_cast<char>(high);
    }
    return refusal_of_bytes(bytes).value_or("accepted");
  };
  EXPECT_EQ(told(6, 0), "accepted");
  EXPECT_TRUE(
      told(0, 0x20).ends_with("bytes for a picture of 8193 x 8193; a whole file is wanted"));
  EXPECT_EQ(told(0, 0x7f),
            "file: a picture of 32513 x 32513; a square geometry image of side 5 .. 8193");
}

TEST(DamagedImage, ExrOfLossyCompressionIsRefused) {
  const GeometryImage image = torus_image(7);
  for (const int compression : {-1, 5, 6, 9}) {  // PXR24, B44, DWAB
    std::string bytes = exr_bytes(image);
    const std::string_view value = attribute_of(bytes, "compression", "compression");
    bytes[static_cast<std::size_t>(value.data() - bytes.data())] = static_cast<char>(compression);
    EXPECT_EQ(refusal_of_bytes(bytes),
              "file: an EXR picture whose compression loses something; a geometry image without "
              "loss is wanted");
  }
}

TEST(DamagedImage, ExrOfManyChannelsIsRefusedAtItsHeader) {
  const auto with_channels = [](int more) {
    std::string bytes = exr_bytes(torus_image(7));
    const std::string_view list = attribute_of(bytes, "channels", "chlist");
    const auto at = static_cast<std::size_t>(list.data() - bytes.data());
    const std::string channel = std::string("X\0\2\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 18);
    for (int i = 0; i < more; ++i) bytes.insert(at + list.size() - 1, channel);
    bytes[at - 4] = static_cast<char>(list.size() + 18 * static_cast<std::size_t>(more));
    return refusal_of_bytes(bytes);
  };
  EXPECT_EQ(with_channels(0), std::nullopt);
  EXPECT_EQ(with_channels(6),
            "file: an EXR picture of more than 8 channels; a geometry image is wanted");
}

/// OpenEXR goes on reading where an attribute's content ends, whatever size it tells.
TEST(DamagedImage, ExrAttributesWhoseSizeIsNotTheirTypesAreRefused) {
  const std::string whole = exr_bytes(torus_image(7));
  const auto with = [&](const std::string& name, const std::string& type, const std::string& more) {
    std::string bytes = whole;
    const std::string attribute =
        name + '\0' + type + '\0' + static_cast<char>(more.size()) + std::string(3, '\0') + more;
    bytes.insert(8, attribute);
    return test::message_of<InputError>([&] { check_exr_header(bytes, "file"); });
  };
  const std::string wrong =
      "file: an EXR attribute of an unknown type or a wrong size; a geometry image is wanted";
  EXPECT_EQ(with("a", "float", "1234"), "");
  EXPECT_EQ(with("a", "string", "any"), "");
  EXPECT_EQ(with("a", "float", "123"), wrong);
  EXPECT_EQ(with("a", "stringvector", "\377\377\377\177"), wrong);
  EXPECT_EQ(with("a", "chlist", std::string("\0\0", 2)),
            "file: a damaged EXR file: a channel list of a wrong size; a geometry image is wanted");
  EXPECT_EQ(with("lineOrder", "lineOrder", std::string("\0", 1)),
            "file: a damaged EXR file: an attribute is there twice; a geometry image is wanted");
}

TEST(DamagedImage, ExrOfTilesDepthOrPartsIsRefusedAtItsHeader) {
  for (const unsigned flag : {0x200U, 0x800U, 0x1000U}) {
    std::string bytes = exr_bytes(torus_image(7));
    bytes[5] = static_cast<char>(flag >> 8U);
    EXPECT_EQ(refusal_of_bytes(bytes),
              "file: an EXR picture of tiles, layers of depth or several parts; a geometry image "
              "is wanted");
  }
}

/// A geometry image as PNG, with compressed text chunks more behind its header chunk.
std::string with_texts(const std::string& key, int count, const std::string& packed) {
  const auto number = [](std::size_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xffU);
    return bytes;
  };
  const std::string chunk = "iTXt" + key + std::string("\0\1\0\0\0", 5) + packed;
  const uLong sum =
      crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
  std::string bytes = png_bytes(torus_image(7));
  for (int i = 0; i < count; ++i) bytes.insert(33, number(chunk.size() - 4) + chunk + number(sum));
  return bytes;
}

std::string packed_spaces(std::size_t count) {
  const std::string much(count, ' ');
  std::string packed(compressBound(much.size()), '\0');
  uLongf size = packed.size();
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                     reinterpret_cast<const Bytef*>(much.data()), much.size()),
            Z_OK);
  packed.resize(size);
  return packed;
}

/// Some kilobytes may not unpack to a hundred megabytes of text, in one chunk or in many.
TEST(DamagedImage, PngTextThatUnpacksToFarMoreIsRefused) {
  const std::string much = packed_spaces(100'000'000);
  for (const char* key : {"weft", "other"})
    EXPECT_TRUE(refusal_of_bytes(with_texts(key, 1, much))
                    .value_or("")
                    .starts_with("file: a damaged PNG file: "));
  const std::string little = packed_spaces(2000);
  EXPECT_EQ(refusal_of_bytes(with_texts("other", 20, little)), std::nullopt);
  EXPECT_EQ(refusal_of_bytes(with_texts("other", 40, little)),
            "file: a damaged PNG file: iTXt: no space in chunk cache; a geometry image is wanted");
}

TEST(DamagedImage, PicturesOfAWrongShapeAreRefused) {
  const std::string text = metadata_text(torus_image(9));
  const auto png = [&](int width, int height, int bits) {
    PngPicture picture{width, height, bits, {}, text};
    picture.bytes.resize(picture.row_bytes() * static_cast<std::size_t>(height));
    return encode_png(picture);
  };
  for (const std::string& bytes : {png(9, 8, 16), png(9, 9, 8), png(4, 4, 16), png(17, 17, 16),
                                   encode_exr(Planes3(17), text), encode_exr(Planes3(4), text)})
    EXPECT_TRUE(refusal_of_bytes(bytes).has_value());
}

}  // namespace
}  // namespace weft
