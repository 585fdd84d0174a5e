#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <vector>

#include "weft/core/assert.h"
#include "weft/mesh/distance.h"

namespace weft {
namespace {

constexpr int leaf_size = 4;

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

/// A binary tree of boxes over runs of triangles. The left child of a node is the next node.
struct ClosestPointQuery::Tree {
  struct Node {
    Box3d box;
    int right = -1;           ///< -1 in a leaf
    int first = 0, last = 0;  ///< the run of places below it
  };
  std::vector<Node> nodes;
  std::vector<int> triangle_at, place_of;     ///< from place in the tree to triangle and back
  std::vector<std::array<Vec3d, 3>> corners;  ///< by place

  explicit Tree(const TriangleMesh& mesh);
  void build(std::span<const Vec3d> centres, int first, int last);
  void fit_boxes();
  void try_place(Vec3d point, int place, ClosestPoint& best) const;
  void search(Vec3d point, ClosestPoint& best) const;
};

ClosestPointQuery::Tree::Tree(const TriangleMesh& mesh)
    : triangle_at(mesh.triangles.size()), place_of(mesh.triangles.size()) {
  const int count = static_cast<int>(mesh.triangles.size());
  WEFT_ASSERT(count > 0);
  std::vector<Vec3d> centres(count);
  for (int t = 0; t < count; ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    centres[t] = (1.0 / 3) * (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]);
  }
  std::iota(triangle_at.begin(), triangle_at.end(), 0);
  build(centres, 0, count);
  for (int place = 0; place < count; ++place) {
    const auto& [a, b, c] = mesh.triangles[triangle_at[place]];
    corners.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
    place_of[triangle_at[place]] = place;
  }
  fit_boxes();
}

void ClosestPointQuery::Tree::build(std::span<const Vec3d> centres, int first, int last) {
  const int self = static_cast<int>(nodes.size());
  nodes.push_back({.box = {}, .first = first, .last = last});
  if (last - first <= leaf_size) return;
  Box3d box;
  for (int i = first; i < last; ++i) box.add(centres[triangle_at[i]]);
  const Vec3d extent = box.extent();
  const auto along = [&](Vec3d p) {
    if (extent.x >= extent.y && extent.x >= extent.z) return p.x;
    return extent.y >= extent.z ? p.y : p.z;
  };
  const int middle = first + (last - first) / 2;
  std::nth_element(triangle_at.begin() + first, triangle_at.begin() + middle,
                   triangle_at.begin() + last, [&](int s, int t) {
                     const double a = along(centres[s]), b = along(centres[t]);
                     return a != b ? a < b : s < t;
                   });
  build(centres, first, middle);
  nodes[self].right = static_cast<int>(nodes.size());
  build(centres, middle, last);
}

void ClosestPointQuery::Tree::fit_boxes() {
  for (int i = static_cast<int>(nodes.size()) - 1; i >= 0; --i) {
    Node& node = nodes[i];
    if (node.right < 0) {
      for (int place = node.first; place < node.last; ++place)
        for (const Vec3d corner : corners[place]) node.box.add(corner);
      continue;
    }
    for (const int child : {i + 1, node.right}) {
      node.box.add(nodes[child].box.lower);
      node.box.add(nodes[child].box.upper);
    }
  }
}

void ClosestPointQuery::Tree::try_place(Vec3d point, int place, ClosestPoint& best) const {
  const auto& [a, b, c] = corners[place];
  const Vec3d position = closest_on_triangle(point, a, b, c);
  const double squared = squared_length(point - position);
  const int triangle = triangle_at[place];
  // Of triangles equally far the first one wins, so that neither the tree nor a hint shows.
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
  stack[depth++] = {0, squared_distance_to_box(point, nodes[0].box)};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.squared > best.squared_distance) continue;
    const Node& node = nodes[visit.node];
    if (node.right < 0) {
      for (int place = node.first; place < node.last; ++place) try_place(point, place, best);
      continue;
    }
    const Visit left{visit.node + 1, squared_distance_to_box(point, nodes[visit.node + 1].box)};
    const Visit right{node.right, squared_distance_to_box(point, nodes[node.right].box)};
    const bool left_first = left.squared <= right.squared;
    stack[depth++] = left_first ? right : left;
    stack[depth++] = left_first ? left : right;
  }
}

ClosestPointQuery::ClosestPointQuery(const TriangleMesh& mesh)
    : tree_(std::make_unique<Tree>(mesh)) {}
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
