#include <algorithm>
#include <cmath>

#include "weft/mesh_colours.h"

namespace weft {
namespace {

/// The fifth root of a number in (0, 1], by Newton's method: the C library's pow may differ from
/// machine to machine.
double fifth_root(double x) {
  double y = 1;
  for (int k = 0; k < 64; ++k) y -= (y - x / (y * y * y * y)) / 5;
  return y;
}

/// The transfer function of sRGB [IEC 61966-2-1].
double linear_of(double display) {
  if (!(display > 0)) return 0;  // what is not a number is black
  display = std::min(display, 1.0);
  if (display <= 0.04045) return display / 12.92;
  const double base = (display + 0.055) / 1.055;
  const double root = fifth_root(base);
  return base * base * root * root;  // to the power of 2.4
}

const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int k = 0; k < 256; ++k) values[k] = static_cast<float>(linear_of(k / 255.0));
    return values;
  }();
  return table;
}

/// Where one number of display space ends and the next begins, in linear light.
const std::array<float, 255>& byte_limits() {
  static const std::array<float, 255> table = [] {
    std::array<float, 255> values{};
    for (int k = 0; k < 255; ++k) values[k] = static_cast<float>(linear_of((k + 0.5) / 255));
    return values;
  }();
  return table;
}

/// Two neighbouring texels along an axis, and how far the place is on its way to the second.
struct Between {
  int first = 0, second = 0;
  double share = 0;
};

/// @param place  in texels, whose centres lie at halves
Between texels_at(double place, int count, bool clamped) {
  if (!clamped) place -= std::floor(place / count) * count;
  place = std::clamp(place, 0.0, static_cast<double>(count)) - 0.5;
  const double whole = std::floor(place);
  const auto inside = [&](double at) {
    const int k = static_cast<int>(at);
    return clamped ? std::clamp(k, 0, count - 1) : (k + count) % count;
  };
  return {inside(whole), inside(whole + 1), place - whole};
}

Vec3d texel(const TexturePicture& picture, int row, int col) {
  const std::array<float, 256>& linear = linear_of_byte();
  const std::uint8_t* at =
      picture.rgb.data() + 3 * (static_cast<std::size_t>(row) * picture.width + col);
  return {linear[at[0]], linear[at[1]], linear[at[2]]};
}

/// Bilinear, in linear light.
Vec3d picture_at(const TexturePicture& picture, Vec2d uv, bool clamped) {
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return {1, 1, 1};
  const Between x = texels_at(uv.x * picture.width, picture.width, clamped);
  const Between y = texels_at((1 - uv.y) * picture.height, picture.height, clamped);
  const auto along = [&](int row) {
    return (1 - x.share) * texel(picture, row, x.first) + x.share * texel(picture, row, x.second);
  };
  return (1 - y.share) * along(y.first) + y.share * along(y.second);
}

Vec3d product(Vec3d a, Vec3d b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

}  // namespace

Vec3f SurfaceColours::at(int triangle, const std::array<double, 3>& weights) const {
  Vec3d colour{1, 1, 1};
  if (!corners.empty()) {
    colour = {};
    for (std::size_t k = 0; k < 3; ++k)
      colour += weights[k] * vec_cast<double>(corners[triangle][k]);
  }
  if (const int number = part_of[triangle]; number >= 0) {
    const Part& part = parts[number];
    colour = product(colour, vec_cast<double>(part.base));
    if (part.picture >= 0 && !uv.empty()) {
      Vec2d place;
      for (std::size_t k = 0; k < 3; ++k)
        place = place + weights[k] * Vec2d{uv[triangle][k].x, uv[triangle][k].y};
      colour = product(colour, picture_at(pictures[part.picture], place, part.clamped));
    }
  }
  return vec_cast<float>(Vec3d{std::clamp(colour.x, 0.0, 1.0), std::clamp(colour.y, 0.0, 1.0),
                               std::clamp(colour.z, 0.0, 1.0)});
}

Vec3f linear_colour(Vec3f display) {
  return vec_cast<float>(Vec3d{linear_of(display.x), linear_of(display.y), linear_of(display.z)});
}

Vec3f display_colour(Vec3f linear) {
  const auto [r, g, b] = display_bytes(linear);
  return {static_cast<float>(r) / 255, static_cast<float>(g) / 255, static_cast<float>(b) / 255};
}

std::array<std::uint8_t, 3> display_bytes(Vec3f linear) {
  const std::array<float, 255>& limits = byte_limits();
  const auto byte = [&](float value) {
    return static_cast<std::uint8_t>(std::upper_bound(limits.begin(), limits.end(), value) -
                                     limits.begin());
  };
  return {byte(linear.x), byte(linear.y), byte(linear.z)};
}

}  // namespace weft
