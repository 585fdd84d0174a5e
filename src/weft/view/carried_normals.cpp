#include <algorithm>
#include <array>
#include <vector>

#include "weft/drawing.h"
#include "weft/error.h"

namespace weft {
namespace {

/// Columns of a 3 x 3 matrix.
using Matrix3 = std::array<Vec3f, 3>;

/// Tangents along u and v, and the unit normal.
struct Frame {
  Vec3f u, v, normal;
};

Frame frame_at(const Planes3& grid, int row, int col) {
  const int last = grid.size() - 1;
  Frame frame;
  frame.u = grid.at(row, std::min(col + 1, last)) - grid.at(row, std::max(col - 1, 0));
  frame.v = grid.at(std::min(row + 1, last), col) - grid.at(std::max(row - 1, 0), col);
  frame.normal = normalized(cross(frame.u, frame.v));
  return frame;
}

Vec3f times(const Matrix3& m, Vec3f v) { return v.x * m[0] + v.y * m[1] + v.z * m[2]; }

/// The inverse transpose of the linear map from one frame to the other; all zero where a frame has
/// no area.
Matrix3 normal_map_of(const Frame& from, const Frame& to) {
  const Vec3f area = cross(to.u, to.v);
  const float size = dot(area, to.normal);
  if (!(size > 0) || !(squared_length(from.normal) > 0)) return {};
  const Vec3f along_u = (1 / size) * cross(to.v, to.normal);
  const Vec3f along_v = (1 / size) * cross(to.normal, to.u);
  const auto column = [&](float u, float v, float n) {
    return u * along_u + v * along_v + n * to.normal;
  };
  return {column(from.u.x, from.v.x, from.normal.x), column(from.u.y, from.v.y, from.normal.y),
          column(from.u.z, from.v.z, from.normal.z)};
}

/// A position between two samples of a row or a column.
struct Between {
  int first = 0, second = 0;
  float share = 0;  // weight of the second
};
Between place_of(int texel, int texels, int samples) {
  const double at = static_cast<double>(texel) / (texels - 1) * (samples - 1);
  const int first = std::min(static_cast<int>(at), samples - 2);
  return {first, first + 1, static_cast<float>(at - first)};
}

}  // namespace

NormalMap carried_normals(const Planes3& rest, const NormalMap& normals, const Planes3& moved) {
  const int n = rest.size(), texels = normals.size();
  if (moved.size() != n || n < 2 || texels < 2)
    throw UsageError("normals of a moved surface", "grids of different sizes",
                     "the same samples before and after are wanted");
  std::vector<Matrix3> maps;
  maps.reserve(static_cast<std::size_t>(n) * n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      maps.push_back(normal_map_of(frame_at(rest, r, c), frame_at(moved, r, c)));
  NormalMap carried{Planes3(texels)};
  for (int r = 0; r < texels; ++r) {
    const Between down = place_of(r, texels, n);
    for (int c = 0; c < texels; ++c) {
      const Between across = place_of(c, texels, n);
      const Vec3f before = normals.normal.at(r, c);
      const auto at = [&](int row, int col) {
        return times(maps[static_cast<std::size_t>(row) * n + col], before);
      };
      const Vec3f upper = (1 - across.share) * at(down.first, across.first) +
                          across.share * at(down.first, across.second);
      const Vec3f lower = (1 - across.share) * at(down.second, across.first) +
                          across.share * at(down.second, across.second);
      const Vec3f after = normalized((1 - down.share) * upper + down.share * lower);
      const bool has_direction = squared_length(after) > 0;
      carried.normal.set(r, c,
                         has_direction ? after : frame_at(moved, down.first, across.first).normal);
    }
  }
  return carried;
}

}  // namespace weft
