#include "weft/mesh/winding.h"

#include <algorithm>
#include <array>
#include <utility>

#include "weft/core/orientation.h"

namespace weft {
namespace {

double component(Vec3d p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// The axis along which a box is thinnest: few triangles lie there on the way out.
int thinnest(const Box3d& box) {
  const Vec3d extent = box.extent();
  if (extent.y <= extent.x && extent.y <= extent.z) return 1;
  return extent.z <= extent.x ? 2 : 0;
}

/// A point seen along an axis: of y its x and z, and of others in turn.
Vec2d flat(Vec3d p, int axis) {
  return {component(p, (axis + 2) % 3), component(p, (axis + 1) % 3)};
}

bool meets(const Box3d& box, Vec3d from, RayAxis ray) {
  const int axis = ray.axis;
  const Vec2d lower = flat(box.lower, axis), upper = flat(box.upper, axis), at = flat(from, axis);
  if (!(lower.x <= at.x && at.x <= upper.x && lower.y <= at.y && at.y <= upper.y)) return false;
  return ray.down ? component(from, axis) >= component(box.lower, axis)
                  : component(from, axis) <= component(box.upper, axis);
}

int sign(double x) { return (x > 0 ? 1 : 0) - (x < 0 ? 1 : 0); }

/// The side of an edge on which a point lies, seen from above. A point on its line is perturbed
/// symbolically along x, and by far less along z, alike for all edges [edelsbrunner90].
int side_of(Vec2d a, Vec2d b, Vec2d p) {
  const int side = orientation(a, b, p);
  if (side != 0) return side;
  return a.y != b.y ? sign(a.y - b.y) : sign(b.x - a.x);
}

/// A triangle's contribution to the winding number of a point: +1 where the ray from there meets it
/// from behind, -1 where it does so from before, else 0.
int part_of(const Corners& t, Vec3d p, RayAxis ray) {
  const int axis = ray.axis;
  const std::array<Vec2d, 3> corners{flat(t[0], axis), flat(t[1], axis), flat(t[2], axis)};
  const Vec2d at = flat(p, axis);
  const int first = side_of(corners[0], corners[1], at);
  for (std::size_t k = 1; k < 3; ++k)
    if (side_of(corners[k], corners[(k + 1) % 3], at) != first) return 0;
  // The normal of a triangle that is counter-clockwise when flat points down.
  const bool above = orientation(t[0], t[1], t[2], p) == first;
  if (ray.down) return above ? 0 : first;
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
    : triangles_(std::move(triangles)), tree_(triangles_) {
  if (!triangles_.empty()) up_ = thinnest(tree_.nodes.front().box);
}

void WindingNumbers::moved() noexcept {
  tree_.fit_boxes(triangles_);
  if (!triangles_.empty()) up_ = thinnest(tree_.nodes.front().box);
}

int WindingNumbers::at(Vec3d point, Vec3d towards) const {
  if (triangles_.empty()) return 0;
  return count_along({up_, component(towards, up_) < 0}, 0, point);
}

int WindingNumbers::count_along(RayAxis ray, int index, Vec3d point) const {
  const BoxTree::Node& node = tree_.nodes[static_cast<std::size_t>(index)];
  if (!meets(node.box, point, ray)) return 0;
  if (node.right >= 0)
    return count_along(ray, index + 1, point) + count_along(ray, node.right, point);
  int count = 0;
  for (int place = node.first; place < node.last; ++place) {
    const int triangle = tree_.triangle_at[static_cast<std::size_t>(place)];
    count += part_of(triangles_[static_cast<std::size_t>(triangle)], point, ray);
  }
  return count;
}

}  // namespace weft
