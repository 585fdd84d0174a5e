#include "weft/mesh/crossings.h"

#include <algorithm>
#include <utility>

#include "weft/core/orientation.h"

namespace weft {
namespace {

using Signs = std::array<int, 3>;

/// The sides of the plane of `t` on which the corners lie.
Signs sides(const Corners& t, const Corners& corners) {
  const auto side = [&](Vec3d p) {
    return p == t[0] || p == t[1] || p == t[2] ? 0 : orientation(t[0], t[1], t[2], p);
  };
  return {side(corners[0]), side(corners[1]), side(corners[2])};
}

bool on_both_sides(const Signs& s) {
  const auto [least, largest] = std::minmax({s[0], s[1], s[2]});
  return least < 0 && largest > 0;
}

/// Rotates the corners so that the first is the only one on its side of the other triangle's plane.
/// @return that side
int put_lone_first(Corners& triangle, const Signs& signs) {
  int k = 0;
  while (signs[k] == 0 || signs[(k + 1) % 3] == signs[k] || signs[(k + 2) % 3] == signs[k]) ++k;
  std::rotate(triangle.begin(), triangle.begin() + k, triangle.end());
  return signs[k];
}

Vec2d project(Vec3d p, int axis) {
  if (axis == 0) return {p.y, p.z};
  return axis == 1 ? Vec2d{p.z, p.x} : Vec2d{p.x, p.y};
}

/// A counter-clockwise triangle in the plane.
using FlatCorners = std::array<Vec2d, 3>;
FlatCorners flatten(const Corners& t, int axis) {
  FlatCorners flat{project(t[0], axis), project(t[1], axis), project(t[2], axis)};
  if (orientation(flat[0], flat[1], flat[2]) < 0) std::swap(flat[1], flat[2]);
  return flat;
}

/// An axis along which the triangle's projection has an area; 3 when there is none.
int axis_with_area(const Corners& t) {
  for (int axis = 0; axis < 3; ++axis)
    if (orientation(project(t[0], axis), project(t[1], axis), project(t[2], axis)) != 0)
      return axis;
  return 3;
}

/// Whether an edge of `a` has all of `b` to its right, or on it.
bool edge_separates(const FlatCorners& a, const FlatCorners& b) {
  for (int k = 0; k < 3; ++k) {
    const auto outside = [&](Vec2d p) { return orientation(a[k], a[(k + 1) % 3], p) <= 0; };
    if (outside(b[0]) && outside(b[1]) && outside(b[2])) return true;
  }
  return false;
}

bool overlap_in_plane(const Corners& a, const Corners& b) {
  const int axis = axis_with_area(a);
  if (axis == 3 || axis_with_area(b) == 3) return false;
  const FlatCorners p = flatten(a, axis), q = flatten(b, axis);
  return !edge_separates(p, q) && !edge_separates(q, p);
}

/// Whether the intervals overlap in which two triangles meet the line of their planes; their order
/// follows from the edges that bound them. @pre each triangle has corners on both sides of the
/// other's plane
bool intervals_overlap(Corners a, const Signs& of_a, Corners b, const Signs& of_b) {
  const int side_of_a = put_lone_first(a, of_a), side_of_b = put_lone_first(b, of_b);
  // Each triangle is reversed, if need be, so that the other's first corner lies above it.
  if (side_of_a < 0) std::swap(b[1], b[2]);
  if (side_of_b < 0) std::swap(a[1], a[2]);
  return orientation(a[0], a[1], b[0], b[1]) < 0 && orientation(a[0], a[2], b[2], b[0]) < 0;
}

/// Visits the pairs of triangles that cross, by descending through pairs of nodes with overlapping
/// boxes.
class PairSearch {
 public:
  using Visit = std::function<void(int s, int t)>;

  PairSearch(std::span<const Corners> a, std::span<const Corners> b, Visit visit)
      : a_(a), b_(b), visit_(std::move(visit)) {}

  void within(const BoxTree& tree, int node) const {
    const BoxTree::Node& n = tree.nodes[node];
    if (n.right < 0) {
      for (int i = n.first; i < n.last; ++i)
        for (int j = i + 1; j < n.last; ++j) try_pair(tree.triangle_at[i], tree.triangle_at[j]);
      return;
    }
    within(tree, node + 1);
    within(tree, n.right);
    between(tree, node + 1, tree, n.right);
  }

  void between(const BoxTree& tree, int node, const BoxTree& other_tree, int other) const {
    const BoxTree::Node &n = tree.nodes[node], &m = other_tree.nodes[other];
    if (!overlap(n.box, m.box)) return;
    if (n.right < 0 && m.right < 0) {
      for (int i = n.first; i < n.last; ++i)
        for (int j = m.first; j < m.last; ++j)
          try_pair(tree.triangle_at[i], other_tree.triangle_at[j]);
    } else if (m.right < 0 || (n.right >= 0 && n.last - n.first >= m.last - m.first)) {
      between(tree, node + 1, other_tree, other);
      between(tree, n.right, other_tree, other);
    } else {
      between(tree, node, other_tree, other + 1);
      between(tree, node, other_tree, m.right);
    }
  }

 private:
  static Box3d box_of(const Corners& t) {
    return {min(min(t[0], t[1]), t[2]), max(max(t[0], t[1]), t[2])};
  }
  void try_pair(int s, int t) const {
    if (overlap(box_of(a_[s]), box_of(b_[t])) && triangles_cross(a_[s], b_[t])) visit_(s, t);
  }

  std::span<const Corners> a_, b_;
  Visit visit_;
};

}  // namespace

bool triangles_cross(const Corners& a, const Corners& b) {
  const Signs of_a = sides(b, a);
  if (!on_both_sides(of_a)) return of_a == Signs{0, 0, 0} && overlap_in_plane(a, b);
  const Signs of_b = sides(a, b);
  return on_both_sides(of_b) && intervals_overlap(a, of_a, b, of_b);
}

bool has_no_area(const Corners& triangle) { return axis_with_area(triangle) == 3; }

void for_self_crossings(std::span<const Corners> surface,
                        const std::function<void(int s, int t)>& visit) {
  if (surface.empty()) return;
  const BoxTree tree(surface);
  const auto ordered = [&](int s, int t) { visit(std::min(s, t), std::max(s, t)); };
  PairSearch(surface, surface, ordered).within(tree, 0);
}

CrossingSurface::CrossingSurface(std::vector<Corners> triangles)
    : triangles_(std::move(triangles)), tree_(triangles_) {}

std::int64_t CrossingSurface::count_self_crossings() const {
  if (triangles_.empty()) return 0;
  std::int64_t count = 0;
  PairSearch(triangles_, triangles_, [&](int, int) { ++count; }).within(tree_, 0);
  return count;
}

std::int64_t CrossingSurface::count_crossings(const CrossingSurface& other) const {
  if (triangles_.empty() || other.triangles_.empty()) return 0;
  std::int64_t count = 0;
  PairSearch(triangles_, other.triangles_, [&](int, int) {
    ++count;
  }).between(tree_, 0, other.tree_, 0);
  return count;
}

}  // namespace weft
