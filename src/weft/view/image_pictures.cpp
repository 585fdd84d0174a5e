#include <algorithm>
#include <cmath>

#include "weft/core/assert.h"
#include "weft/drawing.h"
#include "weft/picture.h"
#include "weft/view/map_picture.h"

namespace weft {
namespace {

/// Pictures of maps are drawn this many times larger, then averaged.
constexpr int oversampling = 3;

std::uint8_t byte_of(float value) {
  // Written so that a not-finite value becomes black.
  return value > 0 ? static_cast<std::uint8_t>(std::lround(std::min(value, 1.0F) * 255))
                   : std::uint8_t{0};
}

/// A square canvas of display-space colours in [0, 1].
struct Canvas {
  int side;
  std::vector<Vec3f> pixels;
  explicit Canvas(int s) : side(s), pixels(static_cast<std::size_t>(s) * s, Vec3f{1, 1, 1}) {}
  Vec3f& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * side + x]; }
};

using Corners = std::array<Vec2d, 3>;

/// Fills the pixels whose centres lie in the triangle, of either orientation.
void fill(Canvas& canvas, const Corners& p, Vec3f colour) {
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  const auto clamped = [&](double v) {
    return static_cast<int>(std::clamp(v, 0.0, canvas.side - 1.0));
  };
  const double turn = cross(p[1] - p[0], p[2] - p[0]) < 0 ? -1 : 1;
  for (int y = clamped(top); y <= clamped(bottom); ++y)
    for (int x = clamped(left); x <= clamped(right); ++x) {
      const Vec2d q{x + 0.5, y + 0.5};
      bool inside = true;
      for (int k = 0; k < 3; ++k)
        inside = inside && turn * cross(p[(k + 1) % 3] - p[k], q - p[k]) >= 0;
      if (inside) canvas.at(x, y) = colour;
    }
}

/// Draws a line one pixel wide.
void line(Canvas& canvas, Vec2d a, Vec2d b, Vec3f colour) {
  const double reach = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
  const int steps = static_cast<int>(std::min(reach, 4.0 * canvas.side)) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Vec2d p = a + (static_cast<double>(i) / steps) * (b - a);
    const int x = static_cast<int>(std::clamp(p.x, 0.0, canvas.side - 1.0));
    const int y = static_cast<int>(std::clamp(p.y, 0.0, canvas.side - 1.0));
    canvas.at(x, y) = colour;
  }
}

Picture averaged(const Canvas& canvas) {
  const int side = canvas.side / oversampling;
  Picture picture{side, side, {}};
  picture.rgb.reserve(std::size_t{3} * side * side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      Vec3f sum;
      for (int i = 0; i < oversampling * oversampling; ++i)
        sum += canvas.pixels[static_cast<std::size_t>(y * oversampling + i / oversampling) *
                                 canvas.side +
                             x * oversampling + i % oversampling];
      const Vec3f mean = (1.0F / (oversampling * oversampling)) * sum;
      for (const float channel : {mean.x, mean.y, mean.z}) picture.rgb.push_back(byte_of(channel));
    }
  return picture;
}

/// Areas and mean square stretch of one triangle of the map from the square to the surface.
struct Patch {
  double plane_area = 0, surface_area = 0;
  double squared_stretch = 0;  ///< half the sum of the squared singular values [sander01]
};

Patch patch_of(const DiskMesh& disk, const SquareMap& map, const Triangle& t) {
  const Vec2d p = map.uv[t[1]] - map.uv[t[0]];
  const Vec2d q = map.uv[t[2]] - map.uv[t[0]];
  const Vec3d e = disk.positions[t[1]] - disk.positions[t[0]];
  const Vec3d f = disk.positions[t[2]] - disk.positions[t[0]];
  const double twice = cross(p, q);
  Patch patch{std::abs(twice) / 2, length(cross(e, f)) / 2, 0};
  if (twice == 0) return patch;
  const Vec3d du = (1 / twice) * (q.y * e - p.y * f);
  const Vec3d dv = (1 / twice) * (p.x * f - q.x * e);
  patch.squared_stretch = (dot(du, du) + dot(dv, dv)) / 2;
  return patch;
}

}  // namespace

Picture colours_of(const GeometryImage& image, int min_side) {
  const int n = image.size();
  const int scale = std::max(1, (min_side + n - 1) / n);
  Picture picture{n * scale, n * scale, {}};
  picture.rgb.reserve(std::size_t{3} * picture.width * picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const int row = y / scale, col = x / scale;
      const Vec3f p = image.mates.is_hole(row * n + col) ? Vec3f{1, 1, 1} : image.cube.at(row, col);
      for (const float channel : {p.x, p.y, p.z}) picture.rgb.push_back(byte_of(channel));
    }
  return picture;
}

Picture draw_map(const MappedDisk& mapped, const MapDrawing& options) {
  return draw_map(mapped.cut.disk, mapped.map, options);
}

Picture draw_map(const DiskMesh& disk, const SquareMap& map, const MapDrawing& options) {
  WEFT_ASSERT(map.uv.size() == disk.positions.size());
  const int longer = std::max(map.size.rows, map.size.cols) - 1;
  WEFT_ASSERT(longer >= 1);
  Canvas canvas(std::max(options.side, 1) * oversampling);
  const double scale = static_cast<double>(canvas.side) / longer;
  double plane = 0, surface = 0;
  for (const Triangle& t : disk.triangles) {
    const Patch patch = patch_of(disk, map, t);
    plane += patch.plane_area;
    surface += patch.surface_area;
  }
  const auto corners = [&](const Triangle& t) {
    return Corners{scale * map.uv[t[0]], scale * map.uv[t[1]], scale * map.uv[t[2]]};
  };
  if (options.stretch && surface > 0)
    for (const Triangle& t : disk.triangles) {
      const double squared = patch_of(disk, map, t).squared_stretch * plane / surface;
      fill(canvas, corners(t), stretch_colour(std::sqrt(squared)));
    }
  for (const Triangle& t : options.edges ? disk.triangles : std::vector<Triangle>{}) {
    const Corners p = corners(t);
    for (int k = 0; k < 3; ++k) line(canvas, p[k], p[(k + 1) % 3], {0.16F, 0.17F, 0.20F});
  }
  return averaged(canvas);
}

}  // namespace weft
