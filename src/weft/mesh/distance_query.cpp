#include <algorithm>
#include <array>
#include <vector>

#include "weft/core/assert.h"
#include "weft/mesh/box_tree.h"
#include "weft/mesh/distance.h"

namespace weft {
namespace {

Vec3d closest_on_segment(Vec3d p, Vec3d a, Vec3d b) {
  const Vec3d edge = b - a;
  const double squared = squared_length(edge);
  const double t = squared > 0 ? std::clamp(dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
  return a + t * edge;
}

double squared_distance_to_box(Vec3d p, const Box3d& box) {
  return squared_length(max(max(box.lower - p, p - box.upper), Vec3d{}));
}

}  // namespace

Vec3d closest_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d normal = cross(b - a, c - a);
  const double wa = dot(normal, cross(b - p, c - p)), wb = dot(normal, cross(c - p, a - p)),
               wc = dot(normal, cross(a - p, b - p));
  const double sum = wa + wb + wc;
  // A convex combination stays on the triangle, also where a sliver's normal is mostly rounding.
  if (wa >= 0 && wb >= 0 && wc >= 0 && sum > 0)
    return (wa / sum) * a + (wb / sum) * b + (wc / sum) * c;
  const std::array candidates{closest_on_segment(p, a, b), closest_on_segment(p, b, c),
                              closest_on_segment(p, c, a)};
  return *std::min_element(candidates.begin(), candidates.end(), [&](Vec3d x, Vec3d y) {
    return squared_length(p - x) < squared_length(p - y);
  });
}

struct ClosestPointQuery::Tree {
  BoxTree boxes;
  std::vector<int> place_of;     ///< from triangle to place in the tree
  std::vector<Corners> corners;  ///< by place

  explicit Tree(const std::vector<Corners>& triangles);
  void try_place(Vec3d point, int place, ClosestPoint& best) const;
  void search(Vec3d point, ClosestPoint& best) const;
};

ClosestPointQuery::Tree::Tree(const std::vector<Corners>& triangles)
    : boxes(triangles), place_of(triangles.size()) {
  WEFT_ASSERT(!triangles.empty());
  corners.reserve(triangles.size());
  for (int place = 0; place < static_cast<int>(triangles.size()); ++place) {
    corners.push_back(triangles[boxes.triangle_at[place]]);
    place_of[boxes.triangle_at[place]] = place;
  }
}

void ClosestPointQuery::Tree::try_place(Vec3d point, int place, ClosestPoint& best) const {
  const auto& [a, b, c] = corners[place];
  const Vec3d position = closest_on_triangle(point, a, b, c);
  const double squared = squared_length(point - position);
  const int triangle = boxes.triangle_at[place];
  // Of triangles equally far the first one wins: the result depends on neither tree nor hint.
  if (squared < best.squared_distance ||
      (squared == best.squared_distance && triangle < best.triangle))
    best = {position, triangle, squared};
}

void ClosestPointQuery::Tree::search(Vec3d point, ClosestPoint& best) const {
  struct Visit {
    int node;
    double squared;
  };
  std::array<Visit, 64> stack;  // the tree halves its runs: depth <= log2(2^31) + 1
  int depth = 0;
  stack[depth++] = {0, squared_distance_to_box(point, boxes.nodes[0].box)};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.squared > best.squared_distance) continue;
    const BoxTree::Node& node = boxes.nodes[visit.node];
    if (node.right < 0) {
      for (int place = node.first; place < node.last; ++place) try_place(point, place, best);
      continue;
    }
    const Visit left{visit.node + 1,
                     squared_distance_to_box(point, boxes.nodes[visit.node + 1].box)};
    const Visit right{node.right, squared_distance_to_box(point, boxes.nodes[node.right].box)};
    const bool left_first = left.squared <= right.squared;
    stack[depth++] = left_first ? right : left;
    stack[depth++] = left_first ? left : right;
  }
}

ClosestPointQuery::ClosestPointQuery(const TriangleMesh& mesh)
    : tree_(std::make_unique<Tree>(corners_of(mesh))) {}
ClosestPointQuery::ClosestPointQuery(ClosestPointQuery&&) noexcept = default;
ClosestPointQuery& ClosestPointQuery::operator=(ClosestPointQuery&&) noexcept = default;
ClosestPointQuery::~ClosestPointQuery() = default;

ClosestPoint ClosestPointQuery::closest(Vec3d point, int hint) const {
  ClosestPoint best;
  tree_->try_place(point, tree_->place_of[hint], best);
  tree_->search(point, best);
  return best;
}

}  // namespace weft
