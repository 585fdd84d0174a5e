#include "weft/mesh/io/gltf_skin.h"

#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "weft/mesh/io/gltf_accessor.h"

namespace weft {
namespace {

Placing from_columns(const GltfObject& skin, std::span<const double> m) {
  for (const double value : m)
    if (!std::isfinite(value))
      skin.fail("has an inverse bind matrix that is not finite", "finite numbers are wanted");
  // Some programs write the last row with rounding errors.
  if (std::fabs(m[3]) + std::fabs(m[7]) + std::fabs(m[11]) + std::fabs(m[15] - 1) > 1e-4)
    skin.fail("has an inverse bind matrix that is not affine", "0 0 0 1 as the last row is wanted");
  return {{{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}}, {m[12], m[13], m[14]}};
}

/// One set of four joints and weights a vertex.
struct InfluenceSet {
  std::vector<double> joints, weights;  ///< [V * 4]
};

InfluenceSet read_set(GltfDocument& document, const GltfObject& attributes, std::size_t number,
                      std::size_t vertices) {
  const GltfObject& root = document.root();
  const std::string joints = fmt::format("JOINTS_{}", number);
  const std::string weights = fmt::format("WEIGHTS_{}", number);
  const std::optional<int> joint_index = attributes.index(joints, root.count("accessors"));
  const std::optional<int> weight_index = attributes.index(weights, root.count("accessors"));
  if (!joint_index || !weight_index)
    attributes.fail(fmt::format("has no {}", joint_index ? weights : joints),
                    "joints and weights of a mesh with a skin are wanted");
  InfluenceSet set{read_gltf_whole_numbers(root, document.buffers(), *joint_index, 4),
                   read_gltf_numbers(root, document.buffers(), *weight_index, 4)};
  if (set.joints.size() != 4 * vertices || set.weights.size() != 4 * vertices)
    attributes.fail(fmt::format("has {} joints and {} weights for {} vertices",
                                set.joints.size() / 4, set.weights.size() / 4, vertices),
                    "one of each for every vertex is wanted");
  return set;
}

/// Appends what of a set moves a vertex.
void add_influences(const GltfObject& primitive, const InfluenceSet& set, std::size_t vertex,
                    std::size_t joints, SkinWeights& weights) {
  for (std::size_t k = 4 * vertex; k < 4 * vertex + 4; ++k) {
    const double weight = set.weights[k];
    if (!(weight >= 0 && weight <= 1e30))
      primitive.fail(fmt::format("has the weight {} at vertex {}", weight, vertex),
                     "weights from 0 to 1 are wanted");
    if (weight == 0) continue;
    if (!(set.joints[k] < static_cast<double>(joints)))
      primitive.fail(fmt::format("names joint {} of {}", set.joints[k], joints),
                     "an existing one, counted from 0, is wanted");
    weights.influences.push_back({static_cast<int>(set.joints[k]), weight});
  }
}

/// Scales the last vertex's weights to add up to 1.
void normalize_last(SkinWeights& weights) {
  double sum = 0;
  for (std::size_t i = weights.first.back(); i < weights.influences.size(); ++i)
    sum += weights.influences[i].weight;
  for (std::size_t i = weights.first.back(); i < weights.influences.size(); ++i)
    weights.influences[i].weight /= sum;
}

}  // namespace

GltfSkin read_gltf_skin(GltfDocument& document, int index) {
  const GltfObject& root = document.root();
  const GltfObject object = root.element("skins", static_cast<std::size_t>(index));
  GltfSkin skin;
  skin.joints = object.indices("joints", root.count("nodes"));
  if (skin.joints.empty()) object.fail("has no joints", "nodes are wanted");
  skin.inverse_binds.resize(skin.joints.size());
  const std::optional<int> matrices = object.index("inverseBindMatrices", root.count("accessors"));
  if (!matrices) return skin;
  const std::vector<double> numbers = read_gltf_numbers(root, document.buffers(), *matrices, 16);
  if (numbers.size() / 16 < skin.joints.size())
    object.fail(fmt::format("has {} inverse bind matrices for {} joints", numbers.size() / 16,
                            skin.joints.size()),
                "one for each is wanted");
  for (std::size_t j = 0; j < skin.joints.size(); ++j)
    skin.inverse_binds[j] = from_columns(object, std::span(numbers).subspan(16 * j, 16));
  return skin;
}

namespace {

/// Where a joint of a skin puts the mesh.
Placing placing_by(const GltfObject& root, const std::vector<int>& parents, const GltfSkin& bound,
                   std::size_t joint) {
  Placing placing = bound.inverse_binds[joint];
  std::size_t steps = 0;
  for (int node = bound.joints[joint]; node >= 0; node = parents[static_cast<std::size_t>(node)]) {
    const GltfObject object = root.element("nodes", static_cast<std::size_t>(node));
    if (++steps > parents.size()) object.fail("is its own ancestor", "a tree of nodes is wanted");
    placing = after(read_transform(object).placing(), placing);
  }
  return placing;
}

}  // namespace

std::array<Placing, 3> bound_placings(GltfDocument& document, int skin) {
  const GltfSkin bound = read_gltf_skin(document, skin);
  const std::vector<int> parents = parents_of(document.root());
  const auto by = [&](std::size_t joint) {
    return placing_by(document.root(), parents, bound, joint);
  };
  const std::size_t last = bound.joints.size() - 1;
  return {by(0), by(last / 2), by(last)};
}

SkinWeights read_skin_weights(GltfDocument& document, const GltfObject& primitive,
                              std::size_t vertices, std::size_t joints) {
  const std::optional<GltfObject> attributes = primitive.object("attributes");
  if (!attributes) primitive.fail("has no attributes", "joints and weights are wanted");
  std::vector<InfluenceSet> sets{read_set(document, *attributes, 0, vertices)};
  while (sets.size() < max_joint_sets && attributes->has(fmt::format("JOINTS_{}", sets.size())))
    sets.push_back(read_set(document, *attributes, sets.size(), vertices));
  SkinWeights weights;
  weights.first.reserve(vertices + 1);
  weights.first.push_back(0);
  for (std::size_t v = 0; v < vertices; ++v) {
    for (const InfluenceSet& set : sets) add_influences(primitive, set, v, joints, weights);
    if (weights.influences.size() == weights.first.back()) {
      const double joint = sets[0].joints[4 * v];
      const bool exists = joint < static_cast<double>(joints);
      weights.influences.push_back({exists ? static_cast<int>(joint) : 0, 1});
    }
    normalize_last(weights);
    weights.first.push_back(weights.influences.size());
  }
  return weights;
}

}  // namespace weft
