#include <algorithm>
#include <array>
#include <cmath>

#include "weft/core/math.h"
#include "weft/picture.h"

namespace weft {
namespace {

/// The colour at a place of a ramp, its stops evenly spaced over [0, 1].
template <std::size_t Count>
Vec3f on_ramp(const std::array<Vec3f, Count>& stops, double place) {
  const double at = std::clamp(place, 0.0, 1.0) * (Count - 1);
  const auto k = std::min(static_cast<std::size_t>(at), Count - 2);
  return stops[k] + static_cast<float>(at - static_cast<double>(k)) * (stops[k + 1] - stops[k]);
}

}  // namespace

Vec3f stretch_colour(double stretch) {
  static constexpr std::array<Vec3f, 5> stops{{{0.10F, 0.25F, 0.62F},
                                               {0.45F, 0.66F, 0.90F},
                                               {0.96F, 0.96F, 0.94F},
                                               {0.95F, 0.58F, 0.38F},
                                               {0.66F, 0.07F, 0.10F}}};
  return on_ramp(stops, 0.5 + std::log2(std::max(stretch, 1e-9)) / 4);
}

Vec3f amount_colour(double share) {
  static constexpr std::array<Vec3f, 5> stops{{{0.99F, 0.97F, 0.85F},
                                               {0.99F, 0.80F, 0.42F},
                                               {0.93F, 0.46F, 0.20F},
                                               {0.70F, 0.13F, 0.22F},
                                               {0.27F, 0.02F, 0.20F}}};
  return on_ramp(stops, share);
}

Vec3f curve_colour(int index) {
  // Hues a golden section apart, in turns bright and dark.
  const double turn = 2 * pi * 0.6180339887 * index;
  const double bright = 0.52 + 0.13 * (index % 3 - 1);
  const auto channel = [&](double phase) {
    return static_cast<float>(std::clamp(bright + 0.42 * cosine(turn - phase), 0.0, 1.0));
  };
  return {channel(0), channel(2 * pi / 3), channel(4 * pi / 3)};
}

Vec3f linear_light(Vec3f display) {
  return {display.x * display.x, display.y * display.y, display.z * display.z};
}

void set_pixel(Picture& picture, int x, int y, Vec3f colour) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture.width + x);
  const std::array channels{colour.x, colour.y, colour.z};
  for (int k = 0; k < 3; ++k)
    picture.rgb[at + k] =
        static_cast<std::uint8_t>(std::lround(std::clamp(channels[k], 0.0F, 1.0F) * 255));
}

Picture blank_picture(int width, int height, Vec3f colour) {
  Picture picture{width, height, {}};
  picture.rgb.resize(std::size_t{3} * width * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) set_pixel(picture, x, y, colour);
  return picture;
}

void paste(Picture& picture, const Picture& part, int x, int y) {
  for (int row = std::max(0, -y); row < std::min(part.height, picture.height - y); ++row) {
    const int first = std::max(0, -x), last = std::min(part.width, picture.width - x);
    if (first >= last) return;
    const auto from = part.rgb.begin() + std::ptrdiff_t{3} * (row * part.width + first);
    std::copy(from, from + std::ptrdiff_t{3} * (last - first),
              picture.rgb.begin() + std::ptrdiff_t{3} * ((y + row) * picture.width + x + first));
  }
}

}  // namespace weft
