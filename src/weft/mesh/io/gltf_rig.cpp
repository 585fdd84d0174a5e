#include "weft/mesh/io/gltf_rig.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "weft/error.h"

namespace weft {
namespace {

Vec3d value_of(const std::optional<KeyCurve>& curve, double seconds, Vec3d otherwise) {
  if (!curve) return otherwise;
  std::array<double, 3> value{};
  curve->evaluate(seconds, value);
  return {value[0], value[1], value[2]};
}

/// Moves points by what their joints make of them, blended linearly.
void skin_points(const SkinWeights& weights, std::span<const Placing> joints,
                 std::span<Vec3d> points) {
  for (std::size_t v = 0; v < points.size(); ++v) {
    Vec3d moved;
    for (const auto& [joint, weight] : weights.of(v))
      moved += weight * joints[static_cast<std::size_t>(joint)].point(points[v]);
    points[v] = moved;
  }
}

NodeTransform transform_at(const GltfRig& rig, const GltfRig::Node& node, double seconds) {
  NodeTransform now = node.rest;
  now.translation = value_of(node.translation, seconds, now.translation);
  now.scale = value_of(node.scale, seconds, now.scale);
  if (!node.rotation) return now;
  node.rotation->evaluate(seconds, now.rotation);
  if (!is_rotation(now.rotation))
    throw InputError(rig.name, fmt::format("a rotation without direction after {} s", seconds),
                     "curves that keep away from 0 are wanted");
  return now;
}

std::vector<Placing> placings_at(const GltfRig& rig, double seconds) {
  std::vector<Placing> placings(rig.nodes.size());
  for (const int n : rig.order) {
    const GltfRig::Node& node = rig.nodes[static_cast<std::size_t>(n)];
    const Placing local = transform_at(rig, node, seconds).placing();
    placings[static_cast<std::size_t>(n)] =
        node.parent < 0 ? local : after(placings[static_cast<std::size_t>(node.parent)], local);
  }
  return placings;
}

std::vector<Vec3d> morphed(const GltfRig& rig, const GltfRig::Block& block, double seconds) {
  std::vector<Vec3d> points = block.shape->positions;
  std::vector<double> weights = block.weights;
  if (block.node >= 0)
    if (const auto& curve = rig.nodes[static_cast<std::size_t>(block.node)].weights)
      curve->evaluate(seconds, weights);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (weights[k] == 0) continue;
    for (const auto& [vertex, offset] : *block.shape->targets[k])
      points[static_cast<std::size_t>(vertex)] += weights[k] * vec_cast<double>(offset);
  }
  return points;
}

std::vector<Placing> joints_of(const GltfSkin& bound, std::span<const Placing> nodes) {
  std::vector<Placing> joints;
  joints.reserve(bound.joints.size());
  for (std::size_t j = 0; j < bound.joints.size(); ++j)
    joints.push_back(
        after(nodes[static_cast<std::size_t>(bound.joints[j])], bound.inverse_binds[j]));
  return joints;
}

}  // namespace

std::vector<Vec3d> positions_at(const GltfRig& rig, double seconds) {
  const std::vector<Placing> nodes = placings_at(rig, seconds);
  std::vector<Vec3d> all;
  for (const GltfRig::Block& block : rig.blocks) {
    std::vector<Vec3d> points = morphed(rig, block, seconds);
    if (block.skin >= 0)
      skin_points(*block.shape->joints,
                  joints_of(rig.skins[static_cast<std::size_t>(block.skin)], nodes), points);
    else if (block.node >= 0)
      for (Vec3d& p : points) p = nodes[static_cast<std::size_t>(block.node)].point(p);
    all.insert(all.end(), points.begin(), points.end());
  }
  std::vector<Vec3d> positions;
  positions.reserve(rig.kept.size());
  for (const int v : rig.kept) positions.push_back(all[static_cast<std::size_t>(v)]);
  return positions;
}

}  // namespace weft
