#include "weft/run/export/glb_layout.h"

#include <numeric>
#include <utility>

#include <nlohmann/json.hpp>

#include "weft/core/json.h"

namespace weft {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Constants of the specification: component types and targets of buffer views.
constexpr int float_type = 5126, index_type = 5125, vertex_target = 34962, index_target = 34963;
constexpr std::uint64_t vector_bytes = 12;

OrderedJson list(Vec3f v) { return {v.x, v.y, v.z}; }

/// The node of the mesh, which transforms the unit and axes of files to metres with y up.
OrderedJson node_json(const FinishedMotion& motion) {
  const MeshFrame& frame = motion.surface->frame();
  OrderedJson node{{"name", motion.name}, {"mesh", 0}};
  const double s = frame.unit.metres;
  if (s != 1) node["scale"] = {s, s, s};
  constexpr double half_root = 0.70710678118654752;
  if (frame.z_up) node["rotation"] = {-half_root, 0.0, 0.0, half_root};
  return node;
}

/// Splits vertices at texture seams: a vertex keeps its first texture coordinate; each other one
/// makes a copy.
class TexturedCopies {
 public:
  explicit TexturedCopies(GlbMesh& mesh)
      : mesh_(mesh), used_(mesh.source.size(), false), next_(mesh.source.size(), -1) {
    mesh.uv.resize(mesh.source.size());
  }

  int with(int vertex, Vec2f uv) {
    auto at = static_cast<std::size_t>(vertex);
    while (used_[at] && !(mesh_.uv[at] == uv)) {
      if (next_[at] < 0) next_[at] = add(vertex);
      at = static_cast<std::size_t>(next_[at]);
    }
    used_[at] = true;
    mesh_.uv[at] = uv;
    return static_cast<int>(at);
  }

 private:
  int add(int vertex) {
    mesh_.source.push_back(vertex);
    mesh_.uv.emplace_back();
    used_.push_back(false);
    next_.push_back(-1);
    return static_cast<int>(mesh_.source.size()) - 1;
  }

  GlbMesh& mesh_;
  std::vector<bool> used_;
  std::vector<int> next_;  // the next copy of the same vertex
};

}  // namespace

GlbMesh glb_mesh(const ExportedSurface& surface) {
  const MeshFaces faces = surface.faces();
  FanCorners fans = fans_of(faces);
  GlbMesh mesh;
  mesh.source.resize(static_cast<std::size_t>(surface.vertices()));
  std::iota(mesh.source.begin(), mesh.source.end(), 0);
  mesh.triangles = std::move(fans.triangles);
  const std::vector<Vec3f> colours = surface.colours();
  if (!faces.has_texture()) {
    mesh.colours = colours;
    return mesh;
  }
  TexturedCopies copies(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int texture = faces.texture_corners[static_cast<std::size_t>(fans.places[t][k])];
      const Vec2f up = texture < 0 ? Vec2f{} : faces.texture[static_cast<std::size_t>(texture)];
      int& corner = mesh.triangles[t][k];
      corner = copies.with(corner, {up.x, 1 - up.y});
    }
  if (!colours.empty())
    for (const int vertex : mesh.source) mesh.colours.push_back(colours[vertex]);
  return mesh;
}

Extremes extremes(const std::vector<Vec3f>& points) {
  Extremes found;
  if (!points.empty()) found = {points[0], points[0]};
  for (const Vec3f p : points) found = {min(found.min, p), max(found.max, p)};
  return found;
}

/// The accessors, referred to by index.
struct GlbParts {
  OrderedJson accessors = OrderedJson::array();
  /// @return its index
  int add(int view, int type, std::size_t count, const char* shape) {
    accessors.push_back(
        {{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}});
    return static_cast<int>(accessors.size()) - 1;
  }
  int add_vectors(int view, std::uint64_t offset, std::size_t count, const Extremes* range) {
    const int number = add(view, float_type, count, "VEC3");
    accessors.back()["byteOffset"] = offset;
    if (range != nullptr) {
      accessors.back()["min"] = list(range->min);
      accessors.back()["max"] = list(range->max);
    }
    return number;
  }
};

GlbLayout::GlbLayout(const GlbMesh& mesh, const FinishedMotion& motion)
    : mesh_(mesh), motion_(motion) {
  const std::uint64_t vertices = mesh.source.size();
  const auto targets = static_cast<std::uint64_t>(motion.frames - 1);
  positions_ = add_view(vector_bytes * vertices);
  normals_ = add_view(vector_bytes * vertices);
  if (!mesh.uv.empty()) uv_ = add_view(sizeof(Vec2f) * vertices);
  if (!mesh.colours.empty()) colours_ = add_view(vector_bytes * vertices);
  triangles_ = add_view(sizeof(Triangle) * mesh.triangles.size());
  if (targets == 0) return;
  targets_ = add_view(2 * vector_bytes * vertices * targets);
  times_ = add_view(sizeof(float) * (targets + 1));
  weights_ = add_view(sizeof(float) * (targets + 1) * targets);
}

int GlbLayout::add_view(std::uint64_t bytes) {
  starts_.push_back(end_);
  sizes_.push_back(bytes);
  end_ += bytes;
  return static_cast<int>(starts_.size()) - 1;
}

namespace {

/// The animation of the weights of morph targets.
OrderedJson animation_json(const std::string& name, int times, int weights) {
  return {{{"name", name},
           {"samplers", {{{"input", times}, {"output", weights}, {"interpolation", "LINEAR"}}}},
           {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
}

}  // namespace

OrderedJson GlbLayout::primitive(const std::vector<Extremes>& positions, GlbParts& parts) const {
  const std::size_t vertices = mesh_.source.size();
  OrderedJson json{{"attributes",
                    {{"POSITION", parts.add_vectors(positions_, 0, vertices, positions.data())},
                     {"NORMAL", parts.add_vectors(normals_, 0, vertices, nullptr)}}},
                   {"material", 0}};
  if (uv_ >= 0) json["attributes"]["TEXCOORD_0"] = parts.add(uv_, float_type, vertices, "VEC2");
  if (colours_ >= 0)
    json["attributes"]["COLOR_0"] = parts.add_vectors(colours_, 0, vertices, nullptr);
  json["indices"] = parts.add(triangles_, index_type, 3 * mesh_.triangles.size(), "SCALAR");
  const std::uint64_t step = vector_bytes * vertices;
  for (int k = 1; k < motion_.frames; ++k) {
    const std::uint64_t start = 2 * step * static_cast<std::uint64_t>(k - 1);
    json["targets"].push_back(
        {{"POSITION", parts.add_vectors(targets_, start, vertices, &positions[k])},
         {"NORMAL", parts.add_vectors(targets_, start + step, vertices, nullptr)}});
  }
  return json;
}

OrderedJson GlbLayout::views() const {
  OrderedJson list = OrderedJson::array();
  for (std::size_t view = 0; view < starts_.size(); ++view) {
    OrderedJson json{{"buffer", 0}, {"byteOffset", starts_[view]}, {"byteLength", sizes_[view]}};
    const auto index = static_cast<int>(view);
    if (index == targets_) json["byteStride"] = vector_bytes;
    if (index != times_ && index != weights_)
      json["target"] = index == triangles_ ? index_target : vertex_target;
    list.push_back(std::move(json));
  }
  return list;
}

std::string GlbLayout::json(const std::vector<Extremes>& positions) const {
  GlbParts parts;
  const std::string& name = motion_.name;
  OrderedJson root{{"asset", {{"version", "2.0"}, {"generator", "Weft"}}},
                   {"scene", 0},
                   {"scenes", {{{"nodes", {0}}}}},
                   {"nodes", {node_json(motion_)}},
                   {"materials", {{{"name", name}, {"doubleSided", true}}}},
                   {"meshes", {{{"name", name}, {"primitives", {primitive(positions, parts)}}}}}};
  if (targets_ >= 0) {
    const auto frames = static_cast<std::size_t>(motion_.frames);
    const int times = parts.add(times_, float_type, frames, "SCALAR");
    parts.accessors.back()["min"] = OrderedJson::array({0.0F});
    parts.accessors.back()["max"] =
        OrderedJson::array({static_cast<float>((motion_.frames - 1) / motion_.frame_rate)});
    const int weights = parts.add(weights_, float_type, frames * (frames - 1), "SCALAR");
    root["animations"] = animation_json(name, times, weights);
  }
  root["accessors"] = std::move(parts.accessors);
  root["bufferViews"] = views();
  root["buffers"] = {{{"byteLength", end_}}};
  return json_text(root);
}

}  // namespace weft
