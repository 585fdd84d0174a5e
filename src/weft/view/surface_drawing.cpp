#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/camera.h"
#include "weft/core/math.h"
#include "weft/drawing.h"
#include "weft/geometry_image.h"
#include "weft/mesh/distance.h"
#include "weft/mesh/shapes/solids.h"
#include "weft/mesh/stretch.h"
#include "weft/mesh/topology.h"
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

constexpr int tube_sides = 10;
constexpr Vec3f node_colour{0.08F, 0.08F, 0.09F};
constexpr Vec3f edge_colour{0.10F, 0.11F, 0.13F};
/// Radius of the balls at nodes relative to that of the tubes.
constexpr double ball_share = 2.0;

/// Any unit vector perpendicular to `along`.
Vec3d across(Vec3d along) {
  const Vec3d other = std::abs(along.y) < 0.7 * length(along) ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
  return normalized(cross(along, other));
}

void append(TriangleMesh& whole, const TriangleMesh& part) {
  const int shift = static_cast<int>(whole.positions.size());
  whole.positions.insert(whole.positions.end(), part.positions.begin(), part.positions.end());
  for (const Triangle& t : part.triangles)
    whole.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
}

void shift(TriangleMesh& mesh, Vec3d by) {
  for (Vec3d& p : mesh.positions) p += by;
}

/// Of the triangles' finite corners; the origin where there are none.
Vec3d middle_of(const TriangleMesh& mesh) {
  Box3d box;
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) {
      const Vec3d p = mesh.positions[v];
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) box.add(p);
    }
  return box.empty() ? Vec3d{} : box.centre();
}

TriangleMesh ball(Vec3d centre, double radius) {
  TriangleMesh mesh = icosphere(radius, 2);
  shift(mesh, centre);
  return mesh;
}

std::vector<std::array<int, 2>> edges_of(const TriangleMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  const EdgeUses uses = edge_uses(static_cast<int>(mesh.positions.size()), mesh.triangles);
  for (int e = 0; e < uses.edge_count(); ++e) {
    const int h = uses.of(e).front();
    edges.push_back({mesh.triangles[h / 3][h % 3], mesh.triangles[h / 3][(h + 1) % 3]});
  }
  return edges;
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
  const double percent = 100 * largest / box_of(error.mesh).diagonal();
  drawing.legend = amount_legend("distance to the mesh", fmt::format("{:.2g} %", percent));
  return drawing;
}

TriangleMesh tube(std::span<const Vec3d> points, double radius) {
  TriangleMesh mesh;
  const int count = static_cast<int>(points.size());
  if (count < 2) return mesh;
  Vec3d side = across(points[1] - points[0]);
  for (int i = 0; i < count; ++i) {
    const Vec3d along = normalized(points[std::min(i + 1, count - 1)] - points[std::max(i - 1, 0)]);
    // Parallel transport: the ring does not twist about the curve.
    const Vec3d carried = side - dot(side, along) * along;
    side = length(carried) > 1e-9 ? normalized(carried) : across(along);
    const Vec3d up = cross(along, side);
    for (int k = 0; k < tube_sides; ++k) {
      const double angle = 2 * pi * k / tube_sides;
      mesh.positions.push_back(points[i] + (radius * cosine(angle)) * side +
                               (radius * sine(angle)) * up);
    }
  }
  for (int i = 0; i + 1 < count; ++i)
    for (int k = 0; k < tube_sides; ++k) {
      const int a = i * tube_sides + k, b = i * tube_sides + (k + 1) % tube_sides;
      mesh.triangles.push_back({a, b, b + tube_sides});
      mesh.triangles.push_back({a, b + tube_sides, a + tube_sides});
    }
  return mesh;
}

SurfacePainter::SurfacePainter(const SurfaceDrawing& drawing, const ViewFrom& view)
    : drawing_(drawing),
      origin_(middle_of(*drawing.mesh)),
      surface_(*drawing.mesh),
      size_{view.width, view.height - (drawing.legend ? legend_height(view.width) : 0)},
      renderer_(size_[0], size_[1]) {
  // Coordinates of pictures have single precision, which does not do far from the origin.
  shift(surface_, -origin_);
  DrawnMesh surface;
  surface.mesh = &surface_;
  surface.revision = 1;
  for (const Vec3f colour : drawing_.colours) surface.colours.push_back(linear_light(colour));
  if (drawing_.show_edges) surface.marked_edges = edges_of(*drawing_.mesh);
  surface.mark_colour = linear_light(edge_colour);
  surface.mark_width = 1;
  scene_.meshes.push_back(surface);

  const double radius = drawing_.curve_radius * box_of(surface_).diagonal();
  DrawnMesh marks;
  marks.revision = 1;
  const auto add = [&](const TriangleMesh& part, Vec3f colour) {
    append(marks_, part);
    marks.colours.resize(marks_.positions.size(), linear_light(colour));
  };
  for (const DrawnCurve& curve : drawing_.curves) {
    add(tube(curve.points, radius), curve.colour);
    if (curve.points.empty()) continue;
    for (const Vec3d end : {curve.points.front(), curve.points.back()})
      add(ball(end, radius), curve.colour);
  }
  for (const Vec3d node : drawing_.nodes) add(ball(node, ball_share * radius), node_colour);
  shift(marks_, -origin_);
  marks.mesh = &marks_;
  if (!marks_.triangles.empty()) scene_.meshes.push_back(marks);
  scene_.on_white = drawing_.on_white;
}

double SurfacePainter::aspect() const { return static_cast<double>(size_[0]) / size_[1]; }

Picture SurfacePainter::draw(const Camera& camera) {
  scene_.camera = camera;
  scene_.camera.eye -= origin_;
  scene_.camera.target -= origin_;
  Picture picture = renderer_.draw(scene_);
  if (drawing_.legend) add_legend(picture, *drawing_.legend);
  return picture;
}

Picture draw_surface(const SurfaceDrawing& drawing, const ViewFrom& view) {
  SurfacePainter painter(drawing, view);
  Outline outline;
  outline.add(*drawing.mesh);
  return painter.draw(
      frame_points(outline.points(), view.azimuth, view.elevation, painter.aspect()));
}

Picture draw_on_white(SurfaceDrawing drawing, const ViewFrom& view) {
  drawing.on_white = true;
  return draw_surface(drawing, view);
}

}  // namespace weft
