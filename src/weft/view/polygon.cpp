#include "weft/view/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "weft/core/math.h"

namespace weft {
namespace {

/// Lines that a row of pixels is looked at along; along each, coverage is exact.
constexpr int lines_a_row = 4;
constexpr int disc_corners = 16;

/// Where an outline meets a horizontal line, in order.
std::vector<double> meetings(std::span<const Vec2d> corners, double y) {
  std::vector<double> found;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2d a = corners[k], b = corners[(k + 1) % corners.size()];
    if ((a.y <= y) != (b.y <= y)) found.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::sort(found.begin(), found.end());
  return found;
}

void add_span(std::vector<double>& cover, double from, double to) {
  from = std::clamp<double>(from, 0, static_cast<double>(cover.size()));
  to = std::clamp<double>(to, 0, static_cast<double>(cover.size()));
  for (int x = static_cast<int>(from); x < to; ++x)
    cover[x] += (std::min(to, x + 1.0) - std::max<double>(from, x)) / lines_a_row;
}

void blend(Picture& picture, int x, int y, Vec3f colour, double share) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture.width + x);
  const auto mixed = [&](std::size_t k, float own) {
    const float below = static_cast<float>(picture.rgb[at + k]) / 255;
    return below + static_cast<float>(share) * (own - below);
  };
  set_pixel(picture, x, y, {mixed(0, colour.x), mixed(1, colour.y), mixed(2, colour.z)});
}

void fill_row(Picture& picture, std::span<const Vec2d> corners, int y, Vec3f colour) {
  std::vector<double> cover(picture.width, 0);
  for (int i = 0; i < lines_a_row; ++i) {
    const std::vector<double> at = meetings(corners, y + (i + 0.5) / lines_a_row);
    for (std::size_t k = 0; k + 1 < at.size(); k += 2) add_span(cover, at[k], at[k + 1]);
  }
  for (int x = 0; x < picture.width; ++x)
    if (cover[x] > 0) blend(picture, x, y, colour, std::min(1.0, cover[x]));
}

void fill_disc(Picture& picture, Vec2d centre, double radius, Vec3f colour) {
  std::array<Vec2d, disc_corners> corners;
  for (int k = 0; k < disc_corners; ++k) {
    const double angle = 2 * pi * k / disc_corners;
    corners[k] = centre + radius * Vec2d{cosine(angle), sine(angle)};
  }
  fill_polygon(picture, corners, colour);
}

}  // namespace

void fill_polygon(Picture& picture, std::span<const Vec2d> corners, Vec3f colour) {
  if (corners.empty()) return;
  const auto [top, bottom] = std::minmax_element(corners.begin(), corners.end(),
                                                 [](Vec2d a, Vec2d b) { return a.y < b.y; });
  const double last = std::min<double>(picture.height - 1, bottom->y);
  for (int y = static_cast<int>(std::max(0.0, top->y)); y <= last; ++y)
    fill_row(picture, corners, y, colour);
}

void draw_line(Picture& picture, std::span<const Vec2d> points, double width, Vec3f colour) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    fill_disc(picture, points[k], 0.5 * width, colour);
    if (k == 0) continue;
    const Vec2d from = points[k - 1], to = points[k], way = to - from;
    if (!(length(way) > 0)) continue;
    const Vec2d aside = (0.5 * width / length(way)) * Vec2d{-way.y, way.x};
    fill_polygon(picture, std::array{from + aside, to + aside, to - aside, from - aside}, colour);
  }
}

}  // namespace weft
