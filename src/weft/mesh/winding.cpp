#include "weft/mesh/winding.h"

#include <algorithm>
#include <utility>

#include "weft/core/orientation.h"

namespace weft {
namespace {

bool straight_above(const Box3d& box, Vec3d p) {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.z <= p.z && p.z <= box.upper.z &&
         p.y <= box.upper.y;
}

Vec2d flat(Vec3d p) { return {p.x, p.z}; }

int sign(double x) { return (x > 0 ? 1 : 0) - (x < 0 ? 1 : 0); }

/// The side of an edge on which a point lies, seen from above. A point on its line is perturbed
/// symbolically along x, and by far less along z, alike for all edges [edelsbrunner90].
int side_of(Vec2d a, Vec2d b, Vec2d p) {
  const int side = orientation(a, b, p);
  if (side != 0) return side;
  return a.y != b.y ? sign(a.y - b.y) : sign(b.x - a.x);
}

/// A triangle's contribution to the winding number of a point: +1 where it lies straight above and
/// faces up, -1 where it faces down, else 0.
int part_of(const Corners& t, Vec3d p) {
  const int first = side_of(flat(t[0]), flat(t[1]), flat(p));
  for (std::size_t k = 1; k < 3; ++k)
    if (side_of(flat(t[k]), flat(t[(k + 1) % 3]), flat(p)) != first) return 0;
  // The normal of a triangle that is counter-clockwise in (x, z) points down.
  const bool above = orientation(t[0], t[1], t[2], p) == first;
  return above ? -first : 0;
}

}  // namespace

bool is_closed(std::span<const Triangle> triangles) {
  std::vector<std::pair<int, int>> forth, back;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3];
      forth.emplace_back(from, to);
      back.emplace_back(to, from);
    }
  std::sort(forth.begin(), forth.end());
  std::sort(back.begin(), back.end());
  return forth == back;
}

WindingNumbers::WindingNumbers(std::vector<Corners> triangles)
    : triangles_(std::move(triangles)), tree_(triangles_) {}

int WindingNumbers::at(Vec3d point) const { return triangles_.empty() ? 0 : count_below(0, point); }

int WindingNumbers::count_below(int index, Vec3d point) const {
  const BoxTree::Node& node = tree_.nodes[static_cast<std::size_t>(index)];
  if (!straight_above(node.box, point)) return 0;
  if (node.right >= 0) return count_below(index + 1, point) + count_below(node.right, point);
  int count = 0;
  for (int place = node.first; place < node.last; ++place) {
    const int triangle = tree_.triangle_at[static_cast<std::size_t>(place)];
    count += part_of(triangles_[static_cast<std::size_t>(triangle)], point);
  }
  return count;
}

}  // namespace weft
