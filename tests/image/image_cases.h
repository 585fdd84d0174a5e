#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "tests/convert/maps.h"
#include "weft/convert/sample.h"
#include "weft/error.h"
#include "weft/image_file.h"

namespace weft::test {

/// A geometry image with all that a file has to keep: mates, and a world map of awkward numbers.
inline GeometryImage torus_image(int n) {
  GeometryImage image = sample_image(maps::torus(n, 12));
  image.world = {{0.1, -1e-30, 1e17 / 3}, 1.0 / 3};
  image.source = "a \"torus\".obj";
  image.source_hash = "0123456789abcdef";
  return image;
}

inline void expect_same_samples(const GeometryImage& a, const GeometryImage& b) {
  ASSERT_EQ(a.size(), b.size());
  for (int sample = 0; sample < a.size() * a.size(); ++sample) {
    const Vec3f p = a.cube.at(sample);
    const Vec3f q = b.cube.at(sample);
    ASSERT_EQ(std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(q.x));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(q.y));
    ASSERT_EQ(std::bit_cast<std::uint32_t>(p.z), std::bit_cast<std::uint32_t>(q.z));
  }
}

inline void expect_same_metadata(const GeometryImage& a, const GeometryImage& b) {
  EXPECT_EQ(a.world.lower, b.world.lower);
  EXPECT_EQ(a.world.scale, b.world.scale);
  EXPECT_EQ(a.mates.intervals(), b.mates.intervals());
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.source_hash, b.source_hash);
}

/// The line that reading ends with; nothing when it was read.
inline std::optional<std::string> refusal_of_bytes(std::string_view bytes) {
  try {
    parse_image(bytes, "file");
  } catch (const InputError& error) {
    return error.what();
  }
  return std::nullopt;
}

}  // namespace weft::test
