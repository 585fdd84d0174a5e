#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/camera.h"
#include "weft/drawing.h"
#include "weft/geometry_image.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/stretch.h"
#include "weft/param/square_map.h"
#include "weft/picture.h"

namespace weft {
namespace {

/// Triangles of a map and the vertices of the closed surface that their corners belong to.
struct MapTriangles {
  std::vector<Vec3d> positions;
  std::vector<Triangle> triangles;  ///< of `positions` and `uv`
  std::vector<Vec2d> uv;
  std::vector<int> vertex_of;  ///< index in the surface's mesh
};

/// Sets the value of each vertex to the area-weighted root mean square stretch of its triangles, in
/// units of the stretch of an area-preserving map.
void set_stretch(const MapTriangles& map, SurfaceValues& result) {
  const std::vector<SurfaceTriangle> surface = surface_triangles(map.positions, map.triangles);
  std::vector<double> weight(result.mesh.positions.size(), 0);
  result.values.assign(weight.size(), 0);
  double plane_area = 0, surface_area = 0;
  for (std::size_t i = 0; i < map.triangles.size(); ++i) {
    const auto& [a, b, c] = map.triangles[i];
    plane_area += 0.5 * cross(map.uv[b] - map.uv[a], map.uv[c] - map.uv[a]);
    surface_area += surface[i].area;
    const double square = triangle_stretch(surface[i], map.uv[a], map.uv[b], map.uv[c]).mean_square;
    for (const int v : map.triangles[i]) {
      weight[map.vertex_of[v]] += surface[i].area;
      result.values[map.vertex_of[v]] += surface[i].area * square;
    }
  }
  const double scale = surface_area > 0 ? plane_area / surface_area : 1;
  for (std::size_t v = 0; v < weight.size(); ++v)
    result.values[v] = weight[v] > 0 ? std::sqrt(result.values[v] / weight[v] * scale) : 1;
}

}  // namespace

SurfaceValues stretch_on_surface(const MappedDisk& mapped) {
  const DiskMesh& disk = mapped.cut.disk;
  SurfaceValues result;
  const int points = 1 + *std::max_element(disk.surface_vertex.begin(), disk.surface_vertex.end());
  result.mesh.positions.resize(points);
  for (std::size_t v = 0; v < disk.positions.size(); ++v)
    result.mesh.positions[disk.surface_vertex[v]] = disk.positions[v];
  result.mesh.triangles = disk.triangles;
  for (Triangle& t : result.mesh.triangles)
    for (int& v : t) v = disk.surface_vertex[v];
  set_stretch({disk.positions, disk.triangles, mapped.map.uv, disk.surface_vertex}, result);
  return result;
}

SurfaceValues stretch_on_surface(const GeometryImage& image) {
  const int n = image.size();
  RebuiltMesh rebuilt = rebuild_mesh(image);
  MapTriangles map{{}, grid_triangles(image), {}, rebuilt.vertex_of};
  for (int sample = 0; sample < n * n; ++sample) {
    map.positions.push_back(image.world.to_world(image.cube.at(sample)));
    map.uv.push_back({static_cast<double>(sample % n), static_cast<double>(sample / n)});
  }
  SurfaceValues result{std::move(rebuilt.mesh), {}};
  set_stretch(map, result);
  return result;
}

SurfaceValues error_on_surface(const GeometryImage& image, const TriangleMesh& mesh) {
  SurfaceValues result{rebuild_mesh(image).mesh, {}};
  result.values.assign(result.mesh.positions.size(), 0);
  const ClosestPointQuery query(mesh);
  int hint = 0;
  for (const Triangle& t : result.mesh.triangles) {
    const auto& p = result.mesh.positions;
    double squared = 0;
    for (const Vec3d probe : {(1.0 / 3) * (p[t[0]] + p[t[1]] + p[t[2]]), 0.5 * (p[t[0]] + p[t[1]]),
                              0.5 * (p[t[1]] + p[t[2]]), 0.5 * (p[t[2]] + p[t[0]])}) {
      const ClosestPoint found = query.closest(probe, hint);
      hint = found.triangle;
      squared = std::max(squared, found.squared_distance);
    }
    for (const int v : t) result.values[v] = std::max(result.values[v], std::sqrt(squared));
  }
  return result;
}

SurfaceDrawing draw_stretch(const SurfaceValues& stretch) {
  SurfaceDrawing drawing;
  drawing.mesh = &stretch.mesh;
  for (const double value : stretch.values) drawing.colours.push_back(stretch_colour(value));
  drawing.legend = stretch_legend("stretch");
  return drawing;
}

SurfaceDrawing draw_error(const SurfaceValues& error) {
  SurfaceDrawing drawing;
  drawing.mesh = &error.mesh;
  const double largest = *std::max_element(error.values.begin(), error.values.end());
  for (const double value : error.values)
    drawing.colours.push_back(amount_colour(largest > 0 ? value / largest : 0));
  const double percent = 100 * largest / bounds(error.mesh).diagonal();
  drawing.legend = amount_legend("distance to the mesh", fmt::format("{:.2g} %", percent));
  return drawing;
}

}  // namespace weft
