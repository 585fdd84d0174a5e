#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "weft/mesh/io/gltf_accessor.h"
#include "weft/mesh/io/gltf_rig.h"
#include "weft/mesh/io/gltf_surface.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"
#include "weft/mesh/weld.h"

namespace weft {
namespace {

using Node = GltfRig::Node;
using Shape = GltfRig::Shape;
using Target = GltfRig::Target;

/// Joints and morph targets of all places of all meshes together.
constexpr std::size_t max_numbers = 10'000'000;

std::string clip_name(const GltfObject& root, std::size_t index) {
  return root.element("animations", index)
      .text("name")
      .value_or(fmt::format("animation_{}", index));
}

GltfObject find_clip(const GltfObject& root, std::string_view clip) {
  const std::size_t count = root.count("animations");
  if (count == 0) root.fail("has no animation", "a file with one is wanted");
  if (clip.empty()) return root.element("animations", 0);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    names.push_back(clip_name(root, i));
    if (names.back() == clip) return root.element("animations", i);
  }
  root.fail(fmt::format("has no animation {}", in_quotes(clip)),
            fmt::format("one of its {}, {}, is wanted", count, quoted_list(names)));
}

std::vector<Node> read_nodes(const GltfObject& root) {
  const std::vector<int> parents = parents_of(root);
  std::vector<Node> nodes(parents.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    nodes[n].rest = read_transform(root.element("nodes", n));
    nodes[n].parent = parents[n];
  }
  return nodes;
}

/// Nodes with their parents before them.
std::vector<int> parents_first(const GltfObject& root, const std::vector<Node>& nodes) {
  std::vector<int> order;
  std::vector<bool> placed(nodes.size(), false);
  std::vector<int> path;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    for (int up = static_cast<int>(n); up >= 0 && !placed[static_cast<std::size_t>(up)];
         up = nodes[static_cast<std::size_t>(up)].parent) {
      if (path.size() > nodes.size())
        root.element("nodes", n).fail("is its own ancestor", "a tree of nodes is wanted");
      path.push_back(up);
    }
    for (; !path.empty(); path.pop_back()) {
      order.push_back(path.back());
      placed[static_cast<std::size_t>(path.back())] = true;
    }
  }
  return order;
}

/// Of vertices at one position the first that a triangle has, else the first; in the order of
/// positions. Primitives may share positions of which each has its own part.
std::vector<int> leading_vertices(const TriangleMesh& mesh) {
  const std::vector<int> first = first_at_position(mesh.positions);
  std::vector<int> leading(first.size(), -1), kept;
  std::vector<bool> used(first.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) used[v] = true;
  for (std::size_t v = 0; v < first.size(); ++v)
    if (used[v] && leading[first[v]] < 0) leading[first[v]] = static_cast<int>(v);
  for (std::size_t v = 0; v < first.size(); ++v)
    if (first[v] == static_cast<int>(v)) kept.push_back(leading[v] >= 0 ? leading[v] : first[v]);
  return kept;
}

/// Reads all of a rig but its animation.
class RigReader {
 public:
  RigReader(GltfDocument& document, std::string_view name)
      : document_(document), root_(document.root()), name_(name) {}

  void read_blocks(GltfRig& rig) {
    const GltfSurface surface = read_gltf_surface(document_);
    require_surface(surface.mesh, name_);
    rig.kept = leading_vertices(surface.mesh);
    for (std::size_t i = 0; i < root_.count("skins"); ++i)
      rig.skins.push_back(read_gltf_skin(document_, static_cast<int>(i)));
    for (const GltfBlock& block : surface.blocks) rig.blocks.push_back(read_block(rig, block));
  }

 private:
  GltfRig::Block read_block(const GltfRig& rig, const GltfBlock& source) {
    const GltfObject mesh = root_.element("meshes", static_cast<std::size_t>(source.mesh));
    GltfRig::Block block;
    block.node = source.node;
    std::vector<double> weights;
    const auto primitive = static_cast<std::size_t>(source.primitive);
    const std::size_t targets = mesh.element("primitives", primitive).count("targets");
    if (source.node >= 0) {
      const GltfObject node = root_.element("nodes", static_cast<std::size_t>(source.node));
      block.skin = node.index("skin", rig.skins.size()).value_or(-1);
      weights = node.numbers("weights", targets);
    }
    if (weights.empty()) weights = mesh.numbers("weights", targets);
    weights.resize(targets);
    numbers_ += targets;
    if (block.skin >= 0) numbers_ += rig.skins[static_cast<std::size_t>(block.skin)].joints.size();
    if (numbers_ > max_numbers)
      root_.fail("has more than 10 million joints and morph targets at all places of its meshes",
                 "fewer are wanted");
    block.weights = std::move(weights);
    block.shape = shape_of(rig, source, block.skin);
    return block;
  }

  std::shared_ptr<const Shape> shape_of(const GltfRig& rig, const GltfBlock& source, int skin) {
    std::shared_ptr<const Shape>& known = shapes_[{source.mesh, source.primitive, skin}];
    if (known) return known;
    const GltfObject primitive =
        root_.element("meshes", static_cast<std::size_t>(source.mesh))
            .element("primitives", static_cast<std::size_t>(source.primitive));
    Shape shape;
    shape.positions = read_gltf_positions(
        root_, document_.buffers(),
        *primitive.object("attributes")->index("POSITION", root_.count("accessors")));
    for (std::size_t k = 0; k < primitive.count("targets"); ++k)
      shape.targets.push_back(target_of(primitive.element("targets", k), shape.positions.size()));
    if (skin >= 0)
      shape.joints = read_skin_weights(document_, primitive, shape.positions.size(),
                                       rig.skins[static_cast<std::size_t>(skin)].joints.size());
    return known = std::make_shared<const Shape>(std::move(shape));
  }

  /// A target without positions, as of normals alone, adds nothing.
  std::shared_ptr<const Target> target_of(const GltfObject& object, std::size_t vertices) {
    const std::optional<int> index = object.index("POSITION", root_.count("accessors"));
    if (!index) return std::make_shared<const Target>();
    std::shared_ptr<const Target>& known = targets_[{*index, vertices}];
    if (!known) known = read_target(object, *index, vertices);
    return known;
  }

  std::shared_ptr<const Target> read_target(const GltfObject& object, int index,
                                            std::size_t vertices) {
    const std::vector<Vec3d> offsets = read_gltf_positions(root_, document_.buffers(), index);
    if (offsets.size() != vertices)
      object.fail(fmt::format("moves {} vertices of {}", offsets.size(), vertices),
                  "all of them are wanted");
    Target target;
    for (std::size_t v = 0; v < vertices; ++v) {
      const Vec3d offset = offsets[v];
      for (const double x : {offset.x, offset.y, offset.z})
        if (const std::string_view fault = coordinate_fault(x); !fault.empty())
          object.fail(fmt::format("has a coordinate that {}", fault), "finite numbers are wanted");
      if (offset != Vec3d{}) target.emplace_back(static_cast<int>(v), vec_cast<float>(offset));
    }
    return std::make_shared<const Target>(std::move(target));
  }

  GltfDocument& document_;
  const GltfObject& root_;
  std::string_view name_;
  std::map<std::tuple<int, int, int>, std::shared_ptr<const Shape>> shapes_;
  std::size_t numbers_ = 0;  // joints and morph targets so far
  std::map<std::pair<int, std::size_t>, std::shared_ptr<const Target>> targets_;  ///< by accessor
};

/// Reads the channels of an animation into the nodes that they move.
class ClipReader {
 public:
  ClipReader(GltfDocument& document, const GltfObject& clip, GltfRig& rig)
      : root_(document.root()), clip_(clip), curves_(document, clip), rig_(rig) {}

  void read() {
    if (clip_.count("channels") == 0) clip_.fail("has no channels", "some are wanted");
    for (std::size_t i = 0; i < clip_.count("channels"); ++i)
      add_channel(clip_.element("channels", i));
  }

 private:
  void add_channel(const GltfObject& channel) {
    const std::optional<GltfObject> target = channel.object("target");
    if (!target) channel.fail("has no target", "one is wanted");
    const std::optional<int> sampler = channel.index("sampler", clip_.count("samplers"));
    if (!sampler) channel.fail("has no sampler", "one is wanted");
    const std::optional<int> number = target->index("node", rig_.nodes.size());
    const std::string path = target->text("path").value_or("");
    if (!number) return;  // left to extensions
    Node& node = rig_.nodes[static_cast<std::size_t>(*number)];
    std::optional<KeyCurve>* curve = curve_of(node, path);
    if (curve == nullptr) return;
    if (*curve) channel.fail(fmt::format("moves the {} a second time", path), "one is wanted");
    if (path != "weights" && node.rest.matrix)
      channel.fail("moves a node that has a matrix",
                   "translation, rotation and scale are wanted in its place");
    const CurveShape shape = shape_of(channel, path, *number);
    *curve = curves_.read(static_cast<std::size_t>(*sampler), shape);
    rig_.duration = std::max(rig_.duration, (*curve)->end());
  }

  /// Null for what extensions move.
  static std::optional<KeyCurve>* curve_of(Node& node, std::string_view path) {
    if (path == "translation") return &node.translation;
    if (path == "rotation") return &node.rotation;
    if (path == "scale") return &node.scale;
    return path == "weights" ? &node.weights : nullptr;
  }

  [[nodiscard]] CurveShape shape_of(const GltfObject& channel, std::string_view path,
                                    int node) const {
    if (path == "rotation") return {4, true, false};
    if (path != "weights") return {3, false, false};
    const std::optional<int> mesh =
        root_.element("nodes", static_cast<std::size_t>(node)).index("mesh", root_.count("meshes"));
    const std::size_t targets = mesh ? targets_of(*mesh) : 0;
    if (targets == 0) channel.fail("moves weights that no mesh has", "morph targets are wanted");
    return {targets, false, true};
  }

  /// All primitives of a mesh have the same number of targets.
  [[nodiscard]] std::size_t targets_of(int index) const {
    const GltfObject mesh = root_.element("meshes", static_cast<std::size_t>(index));
    std::size_t targets = 0;
    for (std::size_t i = 0; i < mesh.count("primitives"); ++i) {
      const std::size_t count = mesh.element("primitives", i).count("targets");
      if (i > 0 && count != targets)
        mesh.fail(fmt::format("has primitives of {} and of {} morph targets", targets, count),
                  "as many of all are wanted");
      targets = count;
    }
    return targets;
  }

  const GltfObject& root_;
  const GltfObject& clip_;
  CurveReader curves_;
  GltfRig& rig_;
};

}  // namespace

GltfRig read_gltf_rig(std::string_view bytes, std::string_view name, std::string_view clip,
                      const std::optional<std::filesystem::path>& folder) {
  GltfDocument document(bytes, name, folder);
  const GltfObject& root = document.root();
  const GltfObject animation = find_clip(root, clip);
  GltfRig rig;
  rig.name = name;
  rig.nodes = read_nodes(root);
  rig.order = parents_first(root, rig.nodes);
  RigReader(document, name).read_blocks(rig);
  ClipReader(document, animation, rig).read();
  return rig;
}

}  // namespace weft
