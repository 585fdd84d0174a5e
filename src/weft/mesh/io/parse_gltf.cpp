#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/json.h"
#include "weft/error.h"
#include "weft/mesh.h"
#include "weft/mesh/io/gltf_accessor.h"
#include "weft/mesh/io/gltf_nodes.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"
#include "weft/repair.h"

// After the glTF 2.0 specification [gltf20]. Why not by a library:
// docs/decisions/0019-own-gltf-reader.md.

namespace weft {
namespace {

constexpr int deepest_nesting = 64;
/// Limit of vertices and triangles for files that show meshes many times; larger files have their
/// size in bytes as the limit.
constexpr std::size_t max_shown_freely = 4'000'000;

enum Mode { points_mode = 0, triangles_mode = 4, strip_mode = 5, fan_mode = 6 };

nlohmann::json parse_text(std::string_view text, std::string_view name) {
  try {
    return parse_json(text, deepest_nesting);
  } catch (const JsonFault& fault) {
    throw InputError(fault.place(name), fault.what(), fault.wanted("a glTF 2.0 mesh is wanted"));
  }
}

/// Refuses a file that requires an extension which changes the geometry, but for quantization.
void check_extensions(const GltfObject& root) {
  // These change how a surface looks or tell who made it, not where it is.
  constexpr std::array<std::string_view, 7> looks{"KHR_materials_", "KHR_texture_", "KHR_lights_",
                                                  "KHR_xmp",        "EXT_texture_", "MSFT_texture_",
                                                  "EXT_lights_"};
  for (const std::string& extension : root.texts("extensionsRequired")) {
    const bool harmless = extension == "KHR_mesh_quantization" ||
                          std::any_of(looks.begin(), looks.end(), [&](std::string_view prefix) {
                            return extension.starts_with(prefix);
                          });
    if (!harmless)
      root.fail(fmt::format("needs the extension {}", extension),
                "an uncompressed mesh of plain glTF 2.0 is wanted");
  }
}

void check_version(const GltfObject& root) {
  const std::optional<GltfObject> asset = root.object("asset");
  if (!asset) root.fail("has no asset", "a glTF 2.0 mesh is wanted");
  const std::string version = asset->text("version").value_or("");
  if (version.starts_with("1.")) root.fail("is glTF 1.0", "glTF 2.0 is wanted");
  if (!version.starts_with("2."))
    asset->fail(fmt::format("tells version '{}'", version), "glTF 2.0 is wanted");
}

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

class Gatherer {
 public:
  Gatherer(const GltfObject& root, GltfBuffers& buffers, std::size_t file_size)
      : root_(root), buffers_(buffers), most_(std::max(max_shown_freely, file_size)) {}

  void add(const PlacedMesh& placed) {
    bases_.clear();
    const GltfObject object = root_.element("meshes", static_cast<std::size_t>(placed.mesh));
    for (std::size_t i = 0; i < object.count("primitives"); ++i)
      add_primitive(object.element("primitives", i), placed.placing);
  }

  TriangleMesh take() {
    if (mesh_.triangles.empty() && (points_ || lines_))
      root_.fail(fmt::format("holds {} only", lines_ ? "lines" : "points"), surface_wanted);
    return std::move(mesh_);
  }

 private:
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
    const auto [base, count] = place_positions(primitive, *position, placing);
    std::vector<Triangle> triangles =
        triangles_of(primitive, mode, corners_of(primitive, static_cast<std::size_t>(count)));
    require_room(primitive, mesh_.triangles.size() + triangles.size());
    if (placing.mirrors())
      for (Triangle& t : triangles) std::swap(t[1], t[2]);
    add_texture(*attributes, triangles, static_cast<std::size_t>(count));
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

  /// Adds an accessor's positions, which the primitives of a mesh may share.
  /// @return first vertex and count
  std::pair<int, int> place_positions(const GltfObject& primitive, int accessor,
                                      const Placing& placing) {
    if (const auto known = bases_.find(accessor); known != bases_.end()) return known->second;
    const std::vector<Vec3d> positions = read_gltf_positions(root_, buffers_, accessor);
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
    return bases_[accessor] = {base, static_cast<int>(positions.size())};
  }

  void require_room(const GltfObject& primitive, std::size_t count) const {
    if (count > most_)
      primitive.fail(fmt::format("is shown so often that there are {} elements", count),
                     fmt::format("at most {} are wanted", most_));
  }

  const GltfObject& root_;
  GltfBuffers& buffers_;
  std::size_t most_;
  TriangleMesh mesh_;
  bool points_ = false, lines_ = false;       ///< whether such were left out
  std::map<int, std::pair<int, int>> bases_;  ///< by accessor, of the mesh that is being added
};

}  // namespace

TriangleMesh parse_gltf(std::string_view bytes, std::string_view name,
                        const std::optional<std::filesystem::path>& folder) {
  const GltfParts parts = split_gltf(bytes, name);
  const nlohmann::json json = parse_text(parts.json, name);
  const GltfObject root(json, name, "");
  check_version(root);
  check_extensions(root);
  GltfBuffers buffers(root, parts.binary, folder);
  Gatherer gatherer(root, buffers, bytes.size());
  for (const PlacedMesh& placed : placed_meshes(root)) gatherer.add(placed);
  TriangleMesh mesh = gatherer.take();
  require_surface(mesh, name);
  keep_whole_texture(mesh);
  return weld_exact(mesh);
}

}  // namespace weft
