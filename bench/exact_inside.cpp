#include "bench/exact_inside.h"

#include "weft/core/orientation.h"

namespace weft::bench {
namespace {

bool straight_above(const Box3d& box, Vec3d p) {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.z <= p.z && p.z <= box.upper.z &&
         p.y <= box.upper.y;
}

/// What the ray upwards from `p` does with a triangle.
enum class Meeting { none, crossing, unclear };
Meeting meet(const Corners& t, Vec3d p) {
  const auto flat = [](Vec3d q) { return Vec2d{q.x, q.z}; };
  bool left = false, right = false, on_edge = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = orientation(flat(t[k]), flat(t[(k + 1) % 3]), flat(p));
    left = left || side > 0;
    right = right || side < 0;
    on_edge = on_edge || side == 0;
  }
  if (left && right) return Meeting::none;
  if (on_edge) return Meeting::unclear;
  // In the plane of x and z a turn to the left has a normal that points down.
  const int beneath = left ? orientation(t[0], t[1], t[2], p) : -orientation(t[0], t[1], t[2], p);
  if (beneath == 0) return Meeting::unclear;
  return beneath > 0 ? Meeting::crossing : Meeting::none;
}

}  // namespace

ExactInside::Side ExactInside::side_of(Vec3d point) const {
  int crossings = 0;
  if (!count(point, 0, crossings)) return Side::unclear;
  return crossings % 2 != 0 ? Side::inside : Side::outside;
}

bool ExactInside::count(Vec3d point, int index, int& crossings) const {
  const BoxTree::Node& node = tree_.nodes[static_cast<std::size_t>(index)];
  if (!straight_above(node.box, point)) return true;
  if (node.right >= 0)
    return count(point, index + 1, crossings) && count(point, node.right, crossings);
  for (int place = node.first; place < node.last; ++place) {
    const int triangle = tree_.triangle_at[static_cast<std::size_t>(place)];
    const Meeting meeting = meet(triangles_[static_cast<std::size_t>(triangle)], point);
    if (meeting == Meeting::unclear) return false;
    if (meeting == Meeting::crossing) ++crossings;
  }
  return true;
}

}  // namespace weft::bench
