#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "weft/mesh/io/gltf_curve.h"
#include "weft/mesh/io/gltf_nodes.h"
#include "weft/mesh/io/gltf_skin.h"
#include "weft/vec.h"

namespace weft {

/// What moves the vertices of a glTF file's surface in one of its animations: nodes, morph targets
/// and skins.
struct GltfRig {
  struct Node {
    NodeTransform rest;
    int parent = -1;
    std::optional<KeyCurve> translation, rotation, scale, weights;
  };
  /// What a morph target adds at full weight, where it adds anything.
  using Target = std::vector<std::pair<int, Vec3f>>;
  /// Vertices of a primitive before anything moves them.
  struct Shape {
    std::vector<Vec3d> positions;
    std::vector<std::shared_ptr<const Target>> targets;
    std::optional<SkinWeights> joints;
  };
  /// A shape where a node shows it.
  struct Block {
    int node = -1, skin = -1;     ///< -1: none
    std::vector<double> weights;  ///< of the targets, where no curve has them
    std::shared_ptr<const Shape> shape;
  };

  std::string name;     ///< of the file
  double duration = 0;  ///< time of the animation's last key [s]
  std::vector<Node> nodes;
  std::vector<int> order;  ///< of the nodes, parents first
  std::vector<GltfSkin> skins;
  std::vector<Block> blocks;
  std::vector<int> kept;  ///< [points] of the blocks' vertices those that parse_gltf keeps

  [[nodiscard]] int points() const { return static_cast<int>(kept.size()); }
};

/// @param name    what errors call the file
/// @param clip    name of the animation, `animation_K` for the K-th if it has none; empty: the
/// first
/// @param folder  where external buffers are looked for; none: they are refused
/// @throws InputError as parse_gltf; for a file without that animation; for whatever is wrong in
/// it,
///         in its nodes, skins or morph targets
GltfRig read_gltf_rig(std::string_view bytes, std::string_view name, std::string_view clip,
                      const std::optional<std::filesystem::path>& folder);

/// Positions of the vertices that parse_gltf gives, in their order: morph targets first, then skins
/// by linear blending, or else nodes [gltf20, 3.7.2 and 3.7.3]. Where vertices of equal positions
/// were joined, the first one of the file leads. A mesh with a skin is where its joints are; its
/// own node does not move it.
/// @return [points] in the coordinates of the file
/// @throws InputError where a rotation has no direction
std::vector<Vec3d> positions_at(const GltfRig& rig, double seconds);

}  // namespace weft
