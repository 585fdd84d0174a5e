#include "weft/mesh/crossings.h"

#include <algorithm>
#include <utility>

#include "weft/core/orientation.h"
#include "weft/mesh/topology.h"

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
  const auto [minimum, maximum] = std::minmax({s[0], s[1], s[2]});
  return minimum < 0 && maximum > 0;
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

/// A triangle of a surface.
struct Placed {
  std::span<const Corners> surface;
  const Neighbours& neighbours;
  int index = 0;
  [[nodiscard]] const Corners& corners() const { return surface[index]; }
  [[nodiscard]] int across(int k) const { return neighbours.across(index, k); }
  [[nodiscard]] Vec3d at(int k) const { return corners()[k % 3]; }
  /// The corner of the neighbour at edge k that is not on it.
  [[nodiscard]] Vec3d beyond(int k) const {
    const int other = across(k);
    for (int i = 0; i < 3; ++i)
      if (neighbours.across(other, i) == index) return surface[other][(i + 2) % 3];
    return at(k);
  }
};

/// Whether an edge in the plane of a triangle passes through its inside.
bool passes_inside(Vec3d from, Vec3d to, const Corners& triangle) {
  const int axis = axis_with_area(triangle);
  if (axis == 3) return false;
  const FlatCorners t = flatten(triangle, axis);
  const Vec2d p = project(from, axis), q = project(to, axis);
  for (int k = 0; k < 3; ++k)
    if (orientation(t[k], t[(k + 1) % 3], p) <= 0 && orientation(t[k], t[(k + 1) % 3], q) <= 0)
      return false;
  return on_both_sides({orientation(p, q, t[0]), orientation(p, q, t[1]), orientation(p, q, t[2])});
}

/// Whether two edges have more than a point in common.
bool lie_on_each_other(Vec3d p, Vec3d q, Vec3d u, Vec3d v) {
  bool along = false;
  for (double Vec3d::*axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
    const double first = std::max(std::min(p.*axis, q.*axis), std::min(u.*axis, v.*axis));
    const double last = std::min(std::max(p.*axis, q.*axis), std::max(u.*axis, v.*axis));
    if (first > last) return false;
    along |= first < last;
  }
  for (int axis = 0; axis < 3 && along; ++axis) {
    const Vec2d a = project(p, axis), b = project(q, axis);
    along = orientation(a, b, project(u, axis)) == 0 && orientation(a, b, project(v, axis)) == 0;
  }
  return along;
}

/// Whether point x is in the wedge that opens counter-clockwise about the line from p to q, from
/// the side of point a to that of b. @pre x is on neither side
bool in_wedge(const std::array<Vec3d, 2>& line, Vec3d a, Vec3d b, Vec3d x) {
  const auto turn = [&](Vec3d from, Vec3d to) { return orientation(line[0], line[1], from, to); };
  const int opening = turn(a, b);
  if (opening > 0) return turn(a, x) > 0 && turn(x, b) > 0;
  if (opening < 0) return !(turn(b, x) > 0 && turn(x, a) > 0);
  return turn(a, x) > 0;
}

/// Whether two surfaces pass through each other at edges i and j that lie on each other: the
/// triangles at one are between those at the other, whichever way one goes around.
bool cross_at_edges(const Placed& s, int i, const Placed& t, int j) {
  if (!lie_on_each_other(s.at(i), s.at(i + 1), t.at(j), t.at(j + 1))) return false;
  const std::array<Vec3d, 2> line{s.at(i), s.at(i + 1)}, other{t.at(j), t.at(j + 1)};
  const std::array<Vec3d, 2> a{s.at(i + 2), s.beyond(i)}, b{t.at(j + 2), t.beyond(j)};
  const auto overlap = [](const std::array<Vec3d, 2>& of_x, Vec3d x,
                          const std::array<Vec3d, 2>& of_y, Vec3d y) {
    const Corners one{of_x[0], of_x[1], x}, two{of_y[0], of_y[1], y};
    return has_no_area(one) || has_no_area(two) || triangles_cross(one, two);
  };
  // Triangles that overlap are a pair of their own.
  if (overlap(line, a[0], line, a[1]) || overlap(other, b[0], other, b[1])) return false;
  for (const Vec3d x : a)
    for (const Vec3d y : b)
      if (overlap(line, x, other, y)) return false;
  return in_wedge(line, a[0], a[1], b[0]) != in_wedge(line, a[0], a[1], b[1]);
}

/// Whether a surface passes through triangle t along an edge of its triangle s, or along one of
/// each. An edge belongs to the lesser of its triangles.
/// @param of_s  the sides of the plane of t on which the corners of s lie
bool edge_crosses(const Placed& s, const Signs& of_s, const Placed& t, bool same) {
  for (int k = 0; k < 3; ++k) {
    const int across = s.across(k);
    if (of_s[k] != 0 || of_s[(k + 1) % 3] != 0 || across < s.index) continue;
    if (same && across == t.index) continue;
    const Corners& plane = t.corners();
    const int side = of_s[(k + 2) % 3];
    if (side != 0 && orientation(plane[0], plane[1], plane[2], s.beyond(k)) == -side &&
        passes_inside(s.at(k), s.at(k + 1), plane))
      return true;
    for (int j = 0; j < 3; ++j)
      if (t.across(j) > t.index && !(same && t.across(j) == s.index) && cross_at_edges(s, k, t, j))
        return true;
  }
  return false;
}

/// Whether two triangles cross, or the surfaces do along edges of theirs.
/// @param same  both are of one surface
bool surfaces_cross(const Placed& s, const Placed& t, bool same) {
  const Corners &a = s.corners(), &b = t.corners();
  const Signs of_a = sides(b, a);
  if (!on_both_sides(of_a))
    return (of_a == Signs{0, 0, 0} && overlap_in_plane(a, b)) || edge_crosses(s, of_a, t, same);
  const Signs of_b = sides(a, b);
  return on_both_sides(of_b) ? intervals_overlap(a, of_a, b, of_b) : edge_crosses(t, of_b, s, same);
}

/// A surface to be searched.
struct Searched {
  std::span<const Corners> triangles;
  const Neighbours& neighbours;
};

/// Visits the pairs of triangles that cross, by descending through pairs of nodes with overlapping
/// boxes.
class PairSearch {
 public:
  using Visit = std::function<void(int s, int t)>;

  PairSearch(Searched a, Searched b, Visit visit) : a_(a), b_(b), visit_(std::move(visit)) {}

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
    if (!overlap(box_of(a_.triangles[s]), box_of(b_.triangles[t]))) return;
    const bool same = a_.triangles.data() == b_.triangles.data();
    if (surfaces_cross({a_.triangles, a_.neighbours, s}, {b_.triangles, b_.neighbours, t}, same))
      visit_(s, t);
  }

  Searched a_, b_;
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

Neighbours::Neighbours(std::span<const Triangle> triangles)
    : across_(triangles.size(), std::array<int, 3>{-1, -1, -1}) {
  int vertices = 0;
  for (const Triangle& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
  const EdgeUses edges = edge_uses(vertices, triangles);
  for (int e = 0; e < edges.edge_count(); ++e) {
    const std::span<const int> of = edges.of(e);
    if (of.size() != 2 || of[0] / 3 == of[1] / 3) continue;
    across_[of[0] / 3][of[0] % 3] = of[1] / 3;
    across_[of[1] / 3][of[1] % 3] = of[0] / 3;
  }
}

void for_self_crossings(std::span<const Corners> surface, const Neighbours& neighbours,
                        const std::function<void(int s, int t)>& visit) {
  if (surface.empty()) return;
  const BoxTree tree(surface);
  const auto ordered = [&](int s, int t) { visit(std::min(s, t), std::max(s, t)); };
  const Searched searched{surface, neighbours};
  PairSearch(searched, searched, ordered).within(tree, 0);
}

CrossingSurface::CrossingSurface(std::vector<Corners> triangles, Neighbours neighbours)
    : triangles_(std::move(triangles)), neighbours_(std::move(neighbours)), tree_(triangles_) {}

std::int64_t CrossingSurface::count_self_crossings() const {
  return count_self_crossings([](int, int) { return false; });
}

std::int64_t CrossingSurface::count_self_crossings(
    const std::function<bool(int s, int t)>& left_out) const {
  if (triangles_.empty()) return 0;
  std::int64_t count = 0;
  const Searched own{triangles_, neighbours_};
  PairSearch(own, own, [&](int s, int t) { count += left_out(s, t) ? 0 : 1; }).within(tree_, 0);
  return count;
}

std::int64_t CrossingSurface::count_crossings(const CrossingSurface& other) const {
  return count_crossings(other, [](int) { return false; });
}

std::int64_t CrossingSurface::count_crossings(const CrossingSurface& other,
                                              const std::function<bool(int t)>& left_out) const {
  if (triangles_.empty() || other.triangles_.empty()) return 0;
  std::int64_t count = 0;
  PairSearch({triangles_, neighbours_}, {other.triangles_, other.neighbours_}, [&](int, int t) {
    count += left_out(t) ? 0 : 1;
  }).between(tree_, 0, other.tree_, 0);
  return count;
}

int CrossingSurface::count_lying_on(const CrossingSurface& other) const {
  if (triangles_.empty() || other.triangles_.empty()) return 0;
  std::vector<char> lying(triangles_.size(), 0);
  const auto visit = [&](int s, int t) {
    if (sides(other.triangles_[t], triangles_[s]) == Signs{0, 0, 0}) lying[s] = 1;
  };
  PairSearch({triangles_, neighbours_}, {other.triangles_, other.neighbours_}, visit)
      .between(tree_, 0, other.tree_, 0);
  return static_cast<int>(std::count(lying.begin(), lying.end(), 1));
}

}  // namespace weft
