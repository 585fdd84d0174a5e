#include "weft/image_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/image/image_cases.h"
#include "tests/support/temporary_folder.h"
#include "weft/core/json.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/image/io/exr_codec.h"
#include "weft/image/io/metadata.h"
#include "weft/image/io/png_codec.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::expect_same_metadata;
using test::expect_same_samples;
using test::torus_image;

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// The line of the error that reading ends with; nothing when it was read.
std::optional<std::string> refusal(const fs::path& path) {
  try {
    read_image(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return std::nullopt;
}

std::string refusal_of_metadata(const std::function<void(nlohmann::json&)>& change) {
  const GeometryImage image = torus_image(9);
  nlohmann::json json = parse_json(metadata_text(image), 9);
  json.erase("checksum");
  change(json);
  try {
    assemble_image(image.cube, json_text(json), "file");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ImageFile, ExrComesBackBitForBit) {
  const test::TemporaryFolder folder;
  const GeometryImage image = torus_image(17);
  write_image(folder / "torus.exr", image);
  const GeometryImage back = read_image(folder / "torus.exr");
  expect_same_samples(image, back);
  expect_same_metadata(image, back);
}

TEST(ImageFile, ExrKeepsTheSmallestAndTheLargestSamples) {
  const test::TemporaryFolder folder;
  GeometryImage image{Planes3(5), BorderMates(5, {}), {}, "", ""};
  image.cube.set(2, 2,
                 {std::numeric_limits<float>::denorm_min(), 1.0F, std::nextafter(1.0F, 0.0F)});
  write_image(folder / "small.exr", image);
  expect_same_samples(image, read_image(folder / "small.exr"));
}

TEST(ImageFile, PngRoundsPositionsTo16BitsAndKeepsTheRest) {
  const test::TemporaryFolder folder;
  const GeometryImage image = torus_image(17);
  write_image(folder / "torus.PNG", image);
  const GeometryImage back = read_image(folder / "torus.PNG");
  expect_same_metadata(image, back);
  EXPECT_TRUE(mates_bit_equal(back));
  for (int sample = 0; sample < 17 * 17; ++sample) {
    const Vec3f error = image.cube.at(sample) - back.cube.at(sample);
    EXPECT_LE(std::max({std::abs(error.x), std::abs(error.y), std::abs(error.z)}), 0.5001F / 65535);
  }
}

/// The figures of docs/formats.md, in parts of the cube's side.
TEST(ImageFile, PngLoses102DecibelsBelowTheCubesSide) {
  const GeometryImage image = torus_image(129);
  const GeometryImage back = parse_image(png_bytes(image), "png");
  double sum = 0, largest = 0;
  const int samples = image.size() * image.size();
  for (int sample = 0; sample < samples; ++sample) {
    const Vec3d error = vec_cast<double>(image.cube.at(sample) - back.cube.at(sample));
    sum += squared_length(error);
    largest = std::max(largest, length(error));
  }
  EXPECT_NEAR(20 * std::log10(1 / std::sqrt(sum / samples)), 102.35, 0.2);
  EXPECT_LT(largest, 1.33e-5);
}

TEST(ImageFile, PngIsStableOnceRounded) {
  const test::TemporaryFolder folder;
  write_image(folder / "a.png", torus_image(9));
  const GeometryImage once = read_image(folder / "a.png");
  write_image(folder / "b.png", once);
  expect_same_samples(once, read_image(folder / "b.png"));
}

TEST(ImageFile, SameImageGivesTheSameBytes) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.exr", "a.png"}) {
    write_image(folder / name, torus_image(9));
    const std::string first = read_file(folder / name);
    write_image(folder / name, torus_image(9));
    EXPECT_EQ(first, read_file(folder / name)) << name;
  }
}

TEST(ImageFile, OtherPicturesAreNoGeometryImages) {
  const test::TemporaryFolder folder;
  const NormalMap normals = sample_normals(maps::sheet(9, 5, maps::flat), 9);
  write_normal_map(folder / "n.exr", normals);
  write_normal_map(folder / "n.png", normals);
  write_bytes(folder / "text.png", "a text\n");
  EXPECT_EQ(refusal(folder / "n.exr"),
            (folder / "n.exr").string() +
                ": an EXR picture that is no geometry image; one that weft wrote is wanted");
  EXPECT_EQ(refusal(folder / "n.png"),
            (folder / "n.png").string() +
                ": a PNG picture that is no geometry image; one that weft wrote is wanted");
  EXPECT_EQ(refusal(folder / "text.png"),
            (folder / "text.png").string() +
                ": neither an EXR nor a PNG file; a geometry image is wanted");
  EXPECT_TRUE(refusal(folder / "missing.exr").has_value());
  EXPECT_TRUE(refusal(folder / "").has_value());
}

TEST(ImageFile, OtherEndingsAreAUsageErrorAndNothingIsWritten) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_image(folder / "a.jpg", torus_image(7)), UsageError);
  EXPECT_THROW(write_normal_map(folder / "a", {}), UsageError);
  EXPECT_THROW(write_image(folder / "no/folder.exr", torus_image(7)), OutputError);
  EXPECT_EQ(folder.entries(), 0);
}

TEST(ImageFile, NormalsBecomeColours) {
  const test::TemporaryFolder folder;
  const NormalMap normals = sample_normals(maps::sheet(9, 5, maps::flat), 5);
  write_normal_map(folder / "n.exr", normals);
  write_normal_map(folder / "n.png", normals);
  EXPECT_GT(fs::file_size(folder / "n.exr"), 100U);
  EXPECT_EQ(read_file(folder / "n.png").substr(16, 10),
            std::string("\0\0\0\5\0\0\0\5\x08\x02", 10));  // width, height, 8 bits, RGB
}

TEST(ImageMetadata, WrongVersionIsNamed) {
  EXPECT_EQ(refusal_of_metadata([](auto& json) { json["version"] = 3; }),
            "file: geometry image of version 3; version 1 or 2");
}

TEST(ImageMetadata, EachMissingFieldIsNamed) {
  for (const char* key : {"version", "size", "mates", "lower", "scale", "source", "source_hash"})
    EXPECT_EQ(refusal_of_metadata([&](auto& json) { json.erase(key); }),
              "file: metadata without \"" + std::string(key) + "\"; what weft wrote");
}

TEST(ImageMetadata, UnchangedMetadataAreAccepted) {
  EXPECT_EQ(refusal_of_metadata([](auto&) {}), "accepted");
}

TEST(ImageMetadata, ValuesOutOfRangeAreRefused) {
  using Json = nlohmann::json;
  const auto refused = [](const char* key, const Json& value) {
    return refusal_of_metadata([&](auto& json) { json[key] = value; }) != "accepted";
  };
  EXPECT_TRUE(refused("size", 17));
  EXPECT_TRUE(refused("size", "9"));
  EXPECT_TRUE(refused("version", 1.5));
  EXPECT_TRUE(refused("version", 18446744073709551615U));
  EXPECT_TRUE(refused("scale", 0));
  EXPECT_TRUE(refused("scale", -1));
  EXPECT_TRUE(refused("scale", nullptr));
  EXPECT_TRUE(refused("lower", Json::array({0, 0})));
  EXPECT_TRUE(refused("lower", Json::array({0, 0, "0"})));
  EXPECT_TRUE(refused("source", 3));
  EXPECT_TRUE(refused("source_hash", "xyz"));
  EXPECT_TRUE(refused("mates", 0));
  EXPECT_TRUE(refused("mates", parse_json("[[0, 24]]", 9)));
  EXPECT_TRUE(refused("mates", parse_json("[[0, 24, 80000]]", 9)));
  EXPECT_TRUE(refused("mates", parse_json("[[-1, 24, 8]]", 9)));
  EXPECT_TRUE(refused("mates", parse_json("[[0, 33, 8]]", 9)));
  EXPECT_TRUE(refused("mates", parse_json("[[0, 24, 8], [0, 24, 8]]", 9)));
}

TEST(ImageMetadata, MatesWithOtherPositionsAreRefused) {
  EXPECT_EQ(refusal_of_metadata([](auto& json) {
              json["mates"] = {{0, 16, 8}};
            }),
            "file: border mates with different positions; an image whose samples were not edited");
}

TEST(ImageMetadata, DeepNestingIsRefused) {
  const std::string deep = "{\"mates\":" + std::string(1000000, '[');
  EXPECT_THROW(assemble_image(Planes3(9), deep, "file"), InputError);
  EXPECT_THROW(assemble_image(Planes3(9), "[]", "file"), InputError);
  EXPECT_THROW(assemble_image(Planes3(9), "", "file"), InputError);
}

TEST(ImageMetadata, SamplesOutsideTheCubeAreRefused) {
  GeometryImage image = torus_image(9);
  const std::string text = metadata_text(image);
  for (const float bad : {-0.001F, 1.001F, std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity()}) {
    Planes3 cube = image.cube;
    cube.set(4, 3, {0.5F, bad, 0.5F});
    try {
      assemble_image(cube, text, "file");
      FAIL() << "accepted " << bad;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("in row 4, column 3"), std::string::npos);
    }
  }
}

TEST(ImageMetadata, EditedSamplesDoNotMatchTheChecksum) {
  GeometryImage image = torus_image(9);
  const std::string text = metadata_text(image);
  image.cube.set(4, 3, {0.5F, 0.5F, 0.5F});
  EXPECT_THROW(assemble_image(image.cube, text, "file"), InputError);
}

}  // namespace
}  // namespace weft
