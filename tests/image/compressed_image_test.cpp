// Compressed images: what comes back, how small it is, and what is refused.
#include "weft/image/io/compressed_image.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/image/image_cases.h"
#include "tests/support/errors.h"
#include "weft/core/random.h"
#include "weft/error.h"
#include "weft/image/io/plane_codec.h"
#include "weft/image/io/range_coder.h"
#include "weft/image_file.h"
#include "weft/mesh_colours.h"

namespace weft {
namespace {

TEST(RangeCoder, GivesBackBitsOfAnyBias) {
  Random random(3);
  std::vector<bool> bits;
  for (int i = 0; i < 50000; ++i) bits.push_back(random.uniform(0, 1) < (i % 3) * 0.499);
  RangeEncoder encoder;
  std::array<AdaptiveBit, 3> models;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    encoder.encode(models[i % 3], bits[i]);
    if (i % 7 == 0) encoder.encode_even(bits[i]);
  }
  const std::string bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  models = {};
  for (std::size_t i = 0; i < bits.size(); ++i) {
    ASSERT_EQ(decoder.decode(models[i % 3]), bits[i]) << i;
    if (i % 7 == 0) {
      ASSERT_EQ(decoder.decode_even(), bits[i]) << i;
    }
  }
  EXPECT_FALSE(decoder.is_short());
  EXPECT_TRUE([&] {
    RangeDecoder cut(std::string_view(bytes).substr(0, bytes.size() / 2));
    for (std::size_t i = 0; i < bits.size(); ++i) cut.decode_even();
    return cut.is_short();
  }());
}

struct ImageCase {
  const char* name;
  GeometryImage image;
};

/// One chart with seams, of a side that halves and of one that does not; charts with holes between.
std::vector<ImageCase> image_cases() {
  std::vector<ImageCase> cases{{"torus 33", test::torus_image(33)},
                               {"torus 20", test::torus_image(20)}};
  for (ImageCase& one : cases) one.image.world = {{0.1, -3, 2}, 1.0 / 3};
  GeometryImage charts = test::torus_image(33);
  charts.world = {{0.1, -3, 2}, 5};
  charts.mates = BorderMates(33, {{"a", 0, 0, 17, 17}, {"b", 20, 4, 9, 25}, {"", 3, 19, 5, 6}},
                             {{0, 100, 8, true}, {20, 70, 5}});
  for (int s = 0; s < 33 * 33; ++s)
    charts.cube.set(s, charts.cube.at(charts.mates.representative(s)));
  cases.push_back({"charts", charts});
  return cases;
}

GeometryImage noisy(GeometryImage image, double amount) {
  Random random(9);
  const int n = image.size();
  for (int s = 0; s < n * n; ++s) {
    const auto off = [&](float x) {
      return static_cast<float>(std::clamp(x + random.uniform(-amount, amount), 0.0, 1.0));
    };
    const Vec3f p = image.cube.at(s);
    image.cube.set(s, {off(p.x), off(p.y), off(p.z)});
  }
  for (int s = 0; s < n * n; ++s) image.cube.set(s, image.cube.at(image.mates.representative(s)));
  return image;
}

TEST(CompressedImage, GivesBackTheQuantisedImageBitForBit) {
  for (const auto& [name, image] : image_cases())
    for (const int steps : {15, 1000, 4095, largest_step_count})
      for (const double noise : {0.0, 0.01, 1.0}) {
        const GeometryImage given = noisy(image, noise);
        const GeometryImage back = parse_image(compressed_bytes(given, steps), "a.weft");
        EXPECT_EQ(exr_bytes(back), exr_bytes(quantised(given, steps)))
            << name << ", " << steps << " steps, noise " << noise;
        EXPECT_TRUE(mates_bit_equal(back));
      }
}

TEST(CompressedImage, SamplesStayWithinTheErrorAskedFor) {
  for (const auto& [name, image] : image_cases())
    for (const double error : {0.02, 0.001}) {
      const GeometryImage given = noisy(image, 0.3);
      const double side = given.world.scale;
      const std::optional<int> steps = steps_for_error(given, error * side);
      ASSERT_TRUE(steps);
      const GeometryImage back = parse_image(compressed_bytes(given, *steps), "a.weft");
      double largest = 0;
      for (int s = 0; s < given.size() * given.size(); ++s)
        if (!given.mates.is_hole(s))
          largest = std::max(largest, length(vec_cast<double>(back.cube.at(s) - given.cube.at(s))));
      EXPECT_LE(largest, error) << name;
      EXPECT_GT(largest, 0.4 * error) << name << ": no finer than it has to be";
    }
  EXPECT_FALSE(steps_for_error(image_cases().front().image, 1e-9));
}

TEST(CompressedImage, KeepsColoursAsBytes) {
  GeometryImage image = image_cases().front().image;
  const int n = image.size();
  image.colours = Planes3(n);
  for (int s = 0; s < n * n; ++s) {
    const float share =
        static_cast<float>(image.mates.representative(s)) / static_cast<float>(n * n);
    image.colours.set(s, {share, 1 - share, 0.5F});
  }
  const GeometryImage back = parse_image(compressed_bytes(image, 4095), "a.weft");
  ASSERT_TRUE(back.has_colours());
  for (int s = 0; s < n * n; ++s)
    EXPECT_EQ(display_bytes(back.colours.at(s)), display_bytes(image.colours.at(s)));
}

TEST(CompressedImage, SmoothSurfacesTakeFewBytes) {
  // A wave: 129 x 129 samples of 12 bits along three axes are 75 kB as they are.
  GeometryImage image;
  constexpr int n = 129;
  image.cube = Planes3(n);
  image.mates = BorderMates(n, {});
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const float u = static_cast<float>(c) / (n - 1), v = static_cast<float>(r) / (n - 1);
      image.cube.set(r, c, {u, v, u * (1 - u) * v});
    }
  EXPECT_LT(compressed_bytes(image, 4095).size(), 10000U);
  EXPECT_GT(compressed_bytes(noisy(image, 0.02), 4095).size(), 30000U);
}

TEST(CompressedImage, DamageIsNoticedAndNeverMore) {
  const GeometryImage image = noisy(image_cases().front().image, 0.01);
  const std::string bytes = compressed_bytes(image, 4095);
  for (std::size_t cut = compressed_mark.size(); cut < bytes.size(); cut += 7)
    EXPECT_NE(test::message_of<InputError>([&] { parse_image(bytes.substr(0, cut), "a.weft"); }),
              "")
        << cut;
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    std::string damaged = bytes;
    const auto at = static_cast<std::size_t>(
        random.uniform(double(compressed_mark.size()), double(bytes.size() - 5)));
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << trial % 8));
    EXPECT_NE(test::message_of<InputError>([&] { parse_image(damaged, "a.weft"); }), "") << at;
  }
  EXPECT_NE(test::message_of<InputError>([&] { parse_image(bytes + "x", "a.weft"); }), "");
}

TEST(CompressedImage, SmallFilesDoNotAskForMuchMemory) {
  std::string bytes = compressed_bytes(image_cases().front().image, 4095);
  bytes.replace(8, 4, std::string("\x01\x20\0\0", 4));  // 8193 samples a side
  EXPECT_EQ(
      test::message_of<InputError>([&] { parse_image(bytes, "a.weft"); }),
      "a.weft: a compressed image with fewer bytes than its samples take; one that weft wrote, "
      "whole, is wanted");
}

}  // namespace
}  // namespace weft
