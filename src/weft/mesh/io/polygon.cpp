#include "weft/mesh/io/polygon.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/error.h"

namespace weft {

void add_polygon(TriangleMesh& mesh, std::span<const int> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void add_polygon(TriangleMesh& mesh, std::span<const int> corners, std::span<const Vec2f> uv) {
  add_polygon(mesh, corners);
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.corner_uv.push_back({uv[0], uv[i - 1], uv[i]});
}

void add_strip(std::vector<Triangle>& triangles, std::span<const int> corners) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const int a = corners[i - 2];
    const int b = corners[i % 2 == 0 ? i - 1 : i];
    const int c = corners[i % 2 == 0 ? i : i - 1];
    if (a != b && b != c && c != a) triangles.push_back({a, b, c});
  }
}

void keep_whole_texture(TriangleMesh& mesh) {
  const auto finite = [](const std::array<Vec2f, 3>& corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [](Vec2f uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); });
  };
  if (mesh.corner_uv.size() == mesh.triangles.size() &&
      std::all_of(mesh.corner_uv.begin(), mesh.corner_uv.end(), finite))
    return;
  mesh.corner_uv.clear();
}

void require_surface(const TriangleMesh& mesh, std::string_view name, bool lines) {
  if (mesh.positions.empty()) throw InputError(name, "has no vertices", "a mesh is wanted");
  if (mesh.triangles.empty())
    throw InputError(name,
                     fmt::format("holds {} only: {} vertices and no faces",
                                 lines ? "lines" : "points", mesh.positions.size()),
                     surface_wanted);
  if (mesh.positions.size() > max_elements || mesh.triangles.size() > max_elements)
    throw InputError(name,
                     fmt::format("has {} vertices and {} triangles", mesh.positions.size(),
                                 mesh.triangles.size()),
                     fmt::format("at most {} of each are wanted", max_elements));
}

void require_text(std::string_view bytes, std::string_view name, std::string_view format) {
  if (bytes.empty()) throw InputError(name, "is empty", fmt::format("{} is wanted", format));
  if (bytes.find('\0') != bytes.npos)
    throw InputError(name, "holds binary data", fmt::format("{} is wanted", format));
}

}  // namespace weft
