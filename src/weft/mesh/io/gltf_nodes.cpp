#include "weft/mesh/io/gltf_nodes.h"

#include <cmath>

namespace weft {
namespace {

Placing from_matrix(const GltfObject& node, const std::vector<double>& m) {
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    node.fail("has a matrix that is not affine", "0 0 0 1 as the last row is wanted");
  return {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[12], m[13], m[14]}};
}

/// Columns of the rotation by a quaternion.
std::array<Vec3d, 3> rotation_axes(const std::array<double, 4>& q) {
  const double size = quaternion_length(q);
  const double x = q[0] / size, y = q[1] / size, z = q[2] / size, w = q[3] / size;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
           {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
           {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}}};
}

std::vector<int> root_nodes(const GltfObject& root) {
  const std::size_t nodes = root.count("nodes");
  const std::size_t scenes = root.count("scenes");
  const std::optional<int> chosen = root.index("scene", scenes);
  if (scenes > 0)
    return root.element("scenes", static_cast<std::size_t>(chosen.value_or(0)))
        .indices("nodes", nodes);
  std::vector<bool> is_child(nodes, false);
  for (std::size_t i = 0; i < nodes; ++i)
    for (const int child : root.element("nodes", i).indices("children", nodes))
      is_child[child] = true;
  std::vector<int> roots;
  for (std::size_t i = 0; i < nodes; ++i)
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  return roots;
}

struct PlacedNode {
  int node = 0;
  Placing placing;  ///< of its parent
};

}  // namespace

Placing after(const Placing& outer, const Placing& inner) {
  return {{outer.direction(inner.axes[0]), outer.direction(inner.axes[1]),
           outer.direction(inner.axes[2])},
          outer.point(inner.offset)};
}

double quaternion_length(std::span<const double> q) {
  return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

bool is_rotation(const std::array<double, 4>& quaternion) {
  const double size = quaternion_length(quaternion);
  return size > 0 && std::isfinite(size);
}

Placing NodeTransform::placing() const {
  if (matrix) return *matrix;
  Placing placing{rotation_axes(rotation), translation};
  const std::array<double, 3> factors{scale.x, scale.y, scale.z};
  for (std::size_t k = 0; k < 3; ++k) placing.axes[k] = factors[k] * placing.axes[k];
  return placing;
}

NodeTransform read_transform(const GltfObject& node) {
  NodeTransform transform;
  const std::vector<double> matrix = node.numbers("matrix", 16);
  if (!matrix.empty()) {
    transform.matrix = from_matrix(node, matrix);
    return transform;
  }
  const std::vector<double> rotation = node.numbers("rotation", 4);
  if (!rotation.empty()) transform.rotation = {rotation[0], rotation[1], rotation[2], rotation[3]};
  if (!is_rotation(transform.rotation))
    node.fail("has a rotation without direction", "a unit quaternion is wanted");
  const std::vector<double> scale = node.numbers("scale", 3);
  if (!scale.empty()) transform.scale = {scale[0], scale[1], scale[2]};
  const std::vector<double> offset = node.numbers("translation", 3);
  if (!offset.empty()) transform.translation = {offset[0], offset[1], offset[2]};
  return transform;
}

std::vector<int> parents_of(const GltfObject& root) {
  const std::size_t count = root.count("nodes");
  std::vector<int> parents(count, -1);
  for (std::size_t n = 0; n < count; ++n)
    for (const int child : root.element("nodes", n).indices("children", count)) {
      if (parents[child] >= 0)
        root.element("nodes", static_cast<std::size_t>(child))
            .fail("is reached twice", "a tree of nodes is wanted");
      parents[child] = static_cast<int>(n);
    }
  return parents;
}

std::vector<PlacedMesh> placed_meshes(const GltfObject& root) {
  std::vector<PlacedMesh> meshes;
  const std::size_t nodes = root.count("nodes"), mesh_count = root.count("meshes");
  if (nodes == 0)
    for (std::size_t i = 0; i < mesh_count; ++i) meshes.push_back({static_cast<int>(i), {}, -1});
  std::vector<PlacedNode> open;
  const auto push = [&](const std::vector<int>& children, const Placing& parent) {
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      open.push_back({*child, parent});
  };
  push(root_nodes(root), {});
  std::vector<bool> seen(nodes, false);
  while (!open.empty()) {
    const PlacedNode next = open.back();
    open.pop_back();
    const GltfObject node = root.element("nodes", static_cast<std::size_t>(next.node));
    if (seen[next.node]) node.fail("is reached twice", "a tree of nodes is wanted");
    seen[next.node] = true;
    const Placing placing = after(next.placing, read_transform(node).placing());
    if (const std::optional<int> mesh = node.index("mesh", mesh_count))
      meshes.push_back({*mesh, placing, next.node});
    push(node.indices("children", nodes), placing);
  }
  return meshes;
}

}  // namespace weft
