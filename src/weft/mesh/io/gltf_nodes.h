#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/mesh/io/gltf_object.h"
#include "weft/vec.h"

namespace weft {

/// An affine map of space: p -> axes * p + offset.
struct Placing {
  std::array<Vec3d, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< columns
  Vec3d offset;

  [[nodiscard]] Vec3d direction(Vec3d d) const {
    return d.x * axes[0] + d.y * axes[1] + d.z * axes[2];
  }
  [[nodiscard]] Vec3d point(Vec3d p) const { return direction(p) + offset; }
  /// Whether the map reverses orientation.
  [[nodiscard]] bool mirrors() const { return dot(axes[0], cross(axes[1], axes[2])) < 0; }
};

/// The composition of two maps: `inner` first, then `outer`.
Placing after(const Placing& outer, const Placing& inner);

/// What places a node in its parent's frame: a matrix, or scale, rotation and translation in this
/// order.
struct NodeTransform {
  std::optional<Placing> matrix;
  Vec3d translation;
  std::array<double, 4> rotation{0, 0, 0, 1};  ///< quaternion x, y, z, w of any length but 0
  Vec3d scale{1, 1, 1};
  [[nodiscard]] Placing placing() const;
};

/// @throws InputError for a matrix that is not affine, or a rotation without direction
NodeTransform read_transform(const GltfObject& node);

/// The norm of a quaternion. @param q  [4]
double quaternion_length(std::span<const double> q);

/// Whether a quaternion has a direction: finite, and not 0.
bool is_rotation(const std::array<double, 4>& quaternion);

/// The parent of each node; -1: none. @throws InputError for a node with two
std::vector<int> parents_of(const GltfObject& root);

/// A mesh of the file where a node puts it.
struct PlacedMesh {
  int mesh = 0;
  Placing placing;
  int node = -1;  ///< -1 in a file without nodes
};

/// The meshes of the default scene: the one that the file names, else its first, else all root
/// nodes; in the order of the nodes, parents first. A file without nodes shows every mesh once, as
/// it is. A mesh with a skin is placed by its node all the same: read_gltf_surface asks its skin.
/// @throws InputError for a node out of range or reached twice, or a matrix that is not affine
std::vector<PlacedMesh> placed_meshes(const GltfObject& root);

}  // namespace weft
