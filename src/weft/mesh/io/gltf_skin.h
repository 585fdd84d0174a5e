#pragma once

#include <array>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "weft/mesh/io/gltf_document.h"
#include "weft/mesh/io/gltf_nodes.h"

namespace weft {

/// The joints of a skin and what brings its mesh's points into their frames at rest.
struct GltfSkin {
  std::vector<int> joints;             ///< [J] nodes
  std::vector<Placing> inverse_binds;  ///< [J]
};

/// @param index  @pre below root().count("skins")
/// @throws InputError for no joints, or matrices that are too few, not affine or not finite
GltfSkin read_gltf_skin(GltfDocument& document, int index);

/// Where the first, a middle and the last joint of a skin put its mesh while nodes are at rest; a
/// mesh with a skin does not go with its own node [gltf20, 3.7.3.3]. It is one place where nodes
/// stand as the mesh was bound to them.
/// @throws InputError as read_gltf_skin, or for a joint that is its own ancestor
std::array<Placing, 3> bound_placings(GltfDocument& document, int skin);

/// Sets of four joints and weights that vertices may have; programs write one or two.
inline constexpr std::size_t max_joint_sets = 8;

/// How much each joint of a skin moves each vertex.
struct SkinWeights {
  struct Influence {
    int joint = 0;
    double weight = 0;
  };
  std::vector<std::size_t> first;     ///< [V + 1] into influences
  std::vector<Influence> influences;  ///< the weights of a vertex add up to 1
  [[nodiscard]] std::span<const Influence> of(std::size_t vertex) const {
    return std::span(influences).subspan(first[vertex], first[vertex + 1] - first[vertex]);
  }
};

/// Reads the joints and weights of a primitive, all of its sets, at most eight of four. The weights
/// of a vertex are scaled to add up to 1; where all are 0 it goes with its first joint, as other
/// programs have it.
/// @param joints  of the skin
/// @throws InputError for none, other numbers than vertices, a weight that is negative or not
///         finite, a joint out of range
SkinWeights read_skin_weights(GltfDocument& document, const GltfObject& primitive,
                              std::size_t vertices, std::size_t joints);

}  // namespace weft
