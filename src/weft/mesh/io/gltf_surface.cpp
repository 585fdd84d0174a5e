#include "weft/mesh/io/gltf_surface.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh/io/gltf_accessor.h"
#include "weft/mesh/io/gltf_nodes.h"
#include "weft/mesh/io/gltf_skin.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"

namespace weft {
namespace {

/// Limit of vertices and triangles for files that show meshes many times; larger files have their
/// size in bytes as the limit.
constexpr std::size_t max_shown_freely = 4'000'000;

enum Mode { points_mode = 0, triangles_mode = 4, strip_mode = 5, fan_mode = 6 };

/// The corners of a primitive as triangles of vertex numbers.
std::vector<Triangle> triangles_of(const GltfObject& primitive, int mode,
                                   const std::vector<int>& corners) {
  const std::size_t count = corners.size();
  if (count < 3 || (mode == triangles_mode && count % 3 != 0))
    primitive.fail(fmt::format("has {} corners", count), "whole triangles are wanted");
  std::vector<Triangle> triangles;
  const std::size_t step = mode == triangles_mode ? 3 : 1;
  triangles.reserve(count / step);
  if (mode == strip_mode) {
    add_strip(triangles, corners);
    return triangles;
  }
  for (std::size_t i = 0; i + 2 < count; i += step) {
    const int a = corners[mode == fan_mode ? 0 : i], b = corners[i + 1], c = corners[i + 2];
    if (mode == triangles_mode || (a != b && b != c && c != a)) triangles.push_back({a, b, c});
  }
  return triangles;
}

/// Whether two maps move points of the unit cube to about the same places.
bool agree(const Placing& a, const Placing& b) {
  constexpr double tolerance = 1e-4;  // of the maps' size: skins are written in single precision
  double apart = length(a.offset - b.offset), size = length(a.offset);
  for (std::size_t k = 0; k < 3; ++k) {
    apart += length(a.axes[k] - b.axes[k]);
    size += length(a.axes[k]);
  }
  return apart <= tolerance * size;
}

/// Where a skin puts its mesh; nothing where its joints do not agree, as in files that were saved
/// in a pose, and for a skin that is not sound, which matters to motions alone.
std::optional<Placing> sound_placing(GltfDocument& document, int skin) {
  try {
    const std::array<Placing, 3> by = bound_placings(document, skin);
    return agree(by[0], by[1]) && agree(by[0], by[2]) ? std::optional(by[0]) : std::nullopt;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// What tells the vertices of primitives apart: the accessors of their positions, and of whatever
/// moves them. Of vertices that differ in texture alone one is enough.
using VertexSource = std::vector<int>;

/// Appends the accessor of an attribute; -1: it has none.
void append_accessor(VertexSource& source, const GltfObject& root, const GltfObject& attributes,
                     const std::string& name) {
  source.push_back(attributes.index(name, root.count("accessors")).value_or(-1));
}

VertexSource vertex_source(const GltfObject& root, const GltfObject& primitive,
                           const GltfObject& attributes) {
  VertexSource source;
  append_accessor(source, root, attributes, "POSITION");
  for (std::size_t set = 0; set < max_joint_sets; ++set)
    for (const char* name : {"JOINTS", "WEIGHTS"})
      append_accessor(source, root, attributes, fmt::format("{}_{}", name, set));
  for (std::size_t k = 0; k < primitive.count("targets"); ++k)
    append_accessor(source, root, primitive.element("targets", k), "POSITION");
  return source;
}

class Gatherer {
 public:
  Gatherer(GltfDocument& document, GltfColours* colours)
      : document_(document),
        colours_(colours),
        root_(document.root()),
        buffers_(document.buffers()),
        max_(std::max(max_shown_freely, document.size())) {}

  void add(const PlacedMesh& placed) {
    bases_.clear();
    const GltfObject object = root_.element("meshes", static_cast<std::size_t>(placed.mesh));
    const Placing placing = rest_placing(placed);
    for (std::size_t i = 0; i < object.count("primitives"); ++i) {
      block_ = {placed.node, placed.mesh, static_cast<int>(i)};
      add_primitive(object.element("primitives", i), placing);
    }
  }

  GltfSurface take() {
    if (mesh_.triangles.empty() && (points_ || lines_))
      root_.fail(fmt::format("holds {} only", lines_ ? "lines" : "points"), surface_wanted);
    return {std::move(mesh_), std::move(blocks_)};
  }

 private:
  /// Where a mesh is at rest: where its skin puts it, if it has a sound one, else its node.
  Placing rest_placing(const PlacedMesh& placed) {
    if (placed.node < 0) return placed.placing;
    const GltfObject node = root_.element("nodes", static_cast<std::size_t>(placed.node));
    if (!node.has("skin") || root_.count("skins") == 0) return placed.placing;
    const std::optional<int> skin = node.index("skin", root_.count("skins"));
    if (!bound_.contains(*skin)) bound_[*skin] = sound_placing(document_, *skin);
    const std::optional<Placing>& bound = bound_[*skin];
    return bound && !agree(*bound, placed.placing) ? *bound : placed.placing;
  }

  void add_primitive(const GltfObject& primitive, const Placing& placing) {
    const auto mode = static_cast<int>(primitive.integer("mode", 0, 6).value_or(triangles_mode));
    if (mode < triangles_mode) {  // points and lines have no surface
      (mode == points_mode ? points_ : lines_) = true;
      return;
    }
    const std::optional<GltfObject> attributes = primitive.object("attributes");
    const std::optional<int> position =
        attributes ? attributes->index("POSITION", root_.count("accessors")) : std::nullopt;
    if (!position) primitive.fail("has no POSITION", "positions are wanted");
    const auto [base, count] =
        place_positions(primitive, vertex_source(root_, primitive, *attributes), placing);
    std::vector<Triangle> triangles =
        triangles_of(primitive, mode, corners_of(primitive, static_cast<std::size_t>(count)));
    require_room(primitive, mesh_.triangles.size() + triangles.size());
    if (placing.mirrors())
      for (Triangle& t : triangles) std::swap(t[1], t[2]);
    add_texture(*attributes, triangles, static_cast<std::size_t>(count));
    if (colours_ != nullptr)
      colours_->add(primitive, *attributes, triangles, static_cast<std::size_t>(count));
    for (const auto& [a, b, c] : triangles)
      mesh_.triangles.push_back({a + base, b + base, c + base});
  }

  /// Adds texture coordinates. If a primitive has none, keep_whole_texture drops those of the mesh.
  void add_texture(const GltfObject& attributes, const std::vector<Triangle>& triangles,
                   std::size_t vertices) {
    const std::optional<int> index = attributes.index("TEXCOORD_0", root_.count("accessors"));
    if (!index) return;
    const std::vector<Vec2f> texture = read_gltf_texture(root_, buffers_, *index, vertices);
    for (const auto& [a, b, c] : triangles)
      mesh_.corner_uv.push_back({texture[a], texture[b], texture[c]});
  }

  [[nodiscard]] std::vector<int> corners_of(const GltfObject& primitive, std::size_t vertices) {
    if (const std::optional<int> index = primitive.index("indices", root_.count("accessors")))
      return read_gltf_indices(root_, buffers_, *index, vertices);
    std::vector<int> corners(vertices);
    for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<int>(i);
    return corners;
  }

  /// Adds a primitive's positions, which others of its mesh may share.
  /// @return first vertex and count
  std::pair<int, int> place_positions(const GltfObject& primitive, const VertexSource& source,
                                      const Placing& placing) {
    if (const auto known = bases_.find(source); known != bases_.end()) return known->second;
    const std::vector<Vec3d> positions = read_gltf_positions(root_, buffers_, source.front());
    const int base = static_cast<int>(mesh_.positions.size());
    require_room(primitive, mesh_.positions.size() + positions.size());
    for (const Vec3d& p : positions) {
      const Vec3d placed = placing.point(p);
      for (const double x : {placed.x, placed.y, placed.z})
        if (const std::string_view fault = coordinate_fault(x); !fault.empty())
          primitive.fail(fmt::format("has a coordinate that {}", fault),
                         "finite numbers are wanted");
      mesh_.positions.push_back(placed);
    }
    block_.base = base;
    block_.count = static_cast<int>(positions.size());
    blocks_.push_back(block_);
    return bases_[source] = {base, block_.count};
  }

  void require_room(const GltfObject& primitive, std::size_t count) const {
    if (count > max_)
      primitive.fail(fmt::format("is shown so often that there are {} elements", count),
                     fmt::format("at most {} are wanted", max_));
  }

  GltfDocument& document_;
  GltfColours* colours_;
  const GltfObject& root_;
  GltfBuffers& buffers_;
  std::size_t max_;
  TriangleMesh mesh_;
  std::vector<GltfBlock> blocks_;
  GltfBlock block_;                                    ///< of the primitive that is being added
  bool points_ = false, lines_ = false;                ///< whether such were left out
  std::map<int, std::optional<Placing>> bound_;        ///< by skin
  std::map<VertexSource, std::pair<int, int>> bases_;  ///< of the mesh that is being added
};

}  // namespace

GltfSurface read_gltf_surface(GltfDocument& document, GltfColours* colours) {
  Gatherer gatherer(document, colours);
  for (const PlacedMesh& placed : placed_meshes(document.root())) gatherer.add(placed);
  return gatherer.take();
}

}  // namespace weft
