#include "weft/mesh/box_tree.h"

#include <algorithm>
#include <numeric>

namespace weft {
namespace {

constexpr int leaf_size = 4;

}  // namespace

std::vector<Corners> corners_of(const TriangleMesh& mesh) {
  std::vector<Corners> corners;
  corners.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    corners.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c]});
  return corners;
}

BoxTree::BoxTree(std::span<const Corners> triangles) : triangle_at(triangles.size()) {
  if (triangles.empty()) return;
  std::vector<Vec3d> centres;
  centres.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) centres.push_back((1.0 / 3) * (a + b + c));
  std::iota(triangle_at.begin(), triangle_at.end(), 0);
  build(centres, 0, static_cast<int>(triangles.size()));
  fit_boxes(triangles);
}

void BoxTree::build(std::span<const Vec3d> centres, int first, int last) {
  const int self = static_cast<int>(nodes.size());
  nodes.push_back({.box = {}, .first = first, .last = last});
  if (last - first <= leaf_size) return;
  Box3d box;
  for (int i = first; i < last; ++i) box.add(centres[triangle_at[i]]);
  const Vec3d extent = box.extent();
  double Vec3d::*axis = &Vec3d::x;
  if (extent.y > extent.x) axis = &Vec3d::y;
  if (extent.z > extent.*axis) axis = &Vec3d::z;
  const int middle = first + (last - first) / 2;
  std::nth_element(triangle_at.begin() + first, triangle_at.begin() + middle,
                   triangle_at.begin() + last, [&](int s, int t) {
                     const double a = centres[s].*axis, b = centres[t].*axis;
                     return a != b ? a < b : s < t;
                   });
  build(centres, first, middle);
  nodes[self].right = static_cast<int>(nodes.size());
  build(centres, middle, last);
}

void BoxTree::fit_boxes(std::span<const Corners> triangles) noexcept {
  for (int i = static_cast<int>(nodes.size()) - 1; i >= 0; --i) {
    Node& node = nodes[i];
    node.box = {};
    if (node.right < 0) {
      for (int place = node.first; place < node.last; ++place)
        for (const Vec3d corner : triangles[triangle_at[place]]) node.box.add(corner);
      continue;
    }
    for (const int child : {i + 1, node.right}) {
      node.box.add(nodes[child].box.lower);
      node.box.add(nodes[child].box.upper);
    }
  }
}

}  // namespace weft
