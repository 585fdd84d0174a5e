#include "weft/run/export/exported_surface.h"

#include <algorithm>
#include <cmath>

#include "weft/core/assert.h"
#include "weft/image/diagonals.h"
#include "weft/mesh/point_normals.h"

namespace weft {
namespace {

/// Some unit vector orthogonal to another.
Vec3d any_across(Vec3d normal) {
  const Vec3d axis = std::abs(normal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  return normalized(cross(normal, axis));
}

}  // namespace

/// Positions and normals of the samples in one frame.
class BoundVertices::Surface {
 public:
  Surface(const SurfacePoints& grid, const std::vector<Triangle>& welded, const Planes3& samples)
      : grid_(grid), samples_(samples), normals_(point_normals(grid.gather(samples), welded)) {}

  /// Local frame at a bond. Normals are interpolated between samples, so that offsets do not jump
  /// where triangles meet.
  [[nodiscard]] Frame at(const Bond& bond) const {
    Frame frame;
    Vec3d normal;
    for (std::size_t k = 0; k < 3; ++k) {
      frame.origin += bond.weights[k] * point(bond.samples[k]);
      normal += bond.weights[k] * normal_of(bond.samples[k]);
    }
    frame.normal = normalized(normal);
    if (!(squared_length(frame.normal) > 0)) frame.normal = {0, 1, 0};
    const Vec3d along = point(bond.along[1]) - point(bond.along[0]);
    frame.tangent = normalized(along - dot(along, frame.normal) * frame.normal);
    if (!(squared_length(frame.tangent) > 0)) frame.tangent = any_across(frame.normal);
    frame.bitangent = cross(frame.normal, frame.tangent);
    return frame;
  }

 private:
  [[nodiscard]] Vec3d point(int sample) const { return vec_cast<double>(samples_.at(sample)); }
  [[nodiscard]] Vec3d normal_of(int sample) const {
    const int vertex = grid_.vertex_of[static_cast<std::size_t>(sample)];
    return vec_cast<double>(normals_[static_cast<std::size_t>(vertex)]);
  }

  const SurfacePoints& grid_;
  const Planes3& samples_;
  std::vector<Vec3f> normals_;  // [vertices of the grid]
};

BoundVertices::Bond BoundVertices::bond_at(Vec2d place, int size, const std::vector<bool>& rising) {
  const auto cell = [&](double x) { return std::clamp(static_cast<int>(x), 0, size - 2); };
  const int col = cell(place.x), row = cell(place.y);
  const double x = std::clamp(place.x - col, 0.0, 1.0), y = std::clamp(place.y - row, 0.0, 1.0);
  const int a = row * size + col, b = a + 1, c = b + size, d = a + size;
  Bond bond;
  if (rising[static_cast<std::size_t>(row) * (size - 1) + col]) {
    if (x >= y) {
      bond = {{a, b, c}, {1 - x, x - y, y}, {a, b}, {}, {}};
    } else {
      bond = {{a, c, d}, {1 - y, x, y - x}, {d, c}, {}, {}};
    }
  } else if (x + y <= 1) {
    bond = {{a, b, d}, {1 - x - y, x, y}, {a, b}, {}, {}};
  } else {
    bond = {{b, c, d}, {1 - y, x + y - 1, 1 - x}, {d, c}, {}, {}};
  }
  return bond;
}

BoundVertices::BoundVertices(const GeometryImage& image, const SurfacePoints& grid,
                             const Rest& rest)
    : grid_(&grid) {
  WEFT_ASSERT(rest.places.size() == rest.vertices.size());
  welded_.reserve(grid.triangles.size());
  for (Triangle t : grid.triangles) {
    for (int& corner : t) corner = grid.vertex_of[static_cast<std::size_t>(corner)];
    welded_.push_back(t);
  }
  const int n = image.size();
  const Grid<Diagonal> diagonals = choose_diagonals(image);
  std::vector<bool> rising;
  for (int r = 0; r < n - 1; ++r)
    for (int c = 0; c < n - 1; ++c) rising.push_back(diagonals(r, c) == Diagonal::rising);
  const Surface surface(grid, welded_, *rest.samples);
  for (std::size_t v = 0; v < rest.vertices.size(); ++v) {
    Bond bond;
    bond.offset = rest.vertices[v];
    if (std::isfinite(rest.places[v].x)) {
      bond = bond_at(rest.places[v], n, rising);
      const Frame frame = surface.at(bond);
      const Vec3d off = rest.vertices[v] - frame.origin;
      bond.offset = {dot(off, frame.tangent), dot(off, frame.bitangent), dot(off, frame.normal)};
      bond.rounding = rest.vertices[v] - frame.point(bond.offset);
    }
    bonds_.push_back(bond);
  }
}

std::vector<Vec3d> BoundVertices::follow(const Planes3& samples) const {
  const Surface surface(*grid_, welded_, samples);
  std::vector<Vec3d> vertices;
  vertices.reserve(bonds_.size());
  for (const Bond& bond : bonds_) {
    if (bond.samples[0] < 0) {
      vertices.push_back(bond.offset);
      continue;
    }
    vertices.push_back(surface.at(bond).point(bond.offset) + bond.rounding);
  }
  return vertices;
}
namespace {

std::vector<Vec3d> placed(const std::vector<Vec3d>& positions, const PlacementMap& placement) {
  std::vector<Vec3d> moved;
  moved.reserve(positions.size());
  for (const Vec3d& p : positions) moved.push_back(placement.point(p));
  return moved;
}

MeshFaces grid_faces(const SurfacePoints& grid) {
  MeshFaces faces;
  faces.sizes.assign(grid.triangles.size(), 3);
  faces.corners.reserve(3 * grid.triangles.size());
  faces.texture_corners.reserve(3 * grid.triangles.size());
  for (const Triangle& t : grid.triangles)
    for (const int sample : t) {
      faces.corners.push_back(grid.vertex_of[static_cast<std::size_t>(sample)]);
      faces.texture_corners.push_back(sample);
    }
  return faces;
}

MeshFaces image_faces(const SurfacePoints& grid) {
  MeshFaces faces = grid_faces(grid);
  const double steps = grid.size - 1;
  for (int r = 0; r < grid.size; ++r)
    for (int c = 0; c < grid.size; ++c)
      faces.texture.push_back({static_cast<float>(c / steps), static_cast<float>(r / steps)});
  return faces;
}

/// Texture coordinates are where a sample lies in its panel; samples without a face have none.
MeshFaces garment_faces(const SurfacePoints& grid, const Planes3& texture) {
  MeshFaces faces = grid_faces(grid);
  std::vector<int> number(static_cast<std::size_t>(grid.size) * grid.size, -1);
  for (const int sample : faces.texture_corners) number[sample] = 0;
  for (std::size_t s = 0; s < number.size(); ++s) {
    if (number[s] < 0) continue;
    number[s] = static_cast<int>(faces.texture.size());
    const Vec3f p = texture.at(static_cast<int>(s));
    faces.texture.push_back({pattern_units * p.x, pattern_units * p.y});
  }
  for (int& corner : faces.texture_corners) corner = number[corner];
  return faces;
}

std::vector<NamedRun> panels_of(const SurfacePoints& grid, const BorderMates& mates) {
  std::vector<NamedRun> panels;
  for (const Chart& chart : mates.charts()) panels.push_back({chart.name, 0, 0});
  for (int f = 0; f < static_cast<int>(grid.triangles.size()); ++f) {
    const std::vector<int>& chart_of = mates.chart_of();
    NamedRun& panel = panels[chart_of.empty() ? 0 : chart_of[grid.triangles[f][0]]];
    if (panel.count++ == 0) panel.first = f;
  }
  return panels;
}

/// The vertices along a seam, those that are not there left out.
NamedRun seam_line(const SurfacePoints& grid, const GarmentSeam& seam) {
  NamedRun line{seam.name, 0, 0};
  for (const auto& [a, b] : seam.pairs) {
    const int vertex = grid.vertex_of[a];
    if (vertex >= 0 && (line.vertices.empty() || line.vertices.back() != vertex))
      line.vertices.push_back(vertex);
  }
  return line;
}

/// Puts the vertices of sewn samples in their middle.
void join_sewn(const SurfacePoints& grid, const BorderMates& sewn, const Planes3& samples,
               std::vector<Vec3f>& points) {
  for (int k = 0; k < sewn.class_count(); ++k) {
    const std::span<const int> copies = sewn.copies(k);
    const int vertex = grid.vertex_of[copies.front()];
    if (vertex < 0) continue;
    Vec3d sum;
    for (const int sample : copies) sum += vec_cast<double>(samples.at(sample));
    points[vertex] = vec_cast<float>((1 / static_cast<double>(copies.size())) * sum);
  }
}

}  // namespace

ExportedSurface::ExportedSurface(const SurfacePoints& grid, const Garment& garment,
                                 const MeshFrame& files)
    : grid_(&grid), garment_(&garment), files_(files) {}

ExportedSurface::ExportedSurface(const SurfacePoints& grid, const GeometryImage& image,
                                 const MeshFrame& files)
    : grid_(&grid), image_(&image), files_(files) {}

ExportedSurface::ExportedSurface(const SurfacePoints& grid, const Source& source,
                                 const MeshFrame& files)
    : grid_(&grid), mesh_(source.mesh), files_(files) {
  const std::vector<Vec3d> vertices = placed(source.mesh->positions, source.placement);
  bound_.emplace(*source.image, grid,
                 BoundVertices::Rest{source.rest, source.mesh->places, vertices});
}

int ExportedSurface::vertices() const {
  return bound_ ? bound_->size() : static_cast<int>(grid_->sample_of.size());
}

MeshFaces ExportedSurface::faces() const {
  if (bound_) return mesh_->faces;
  return garment_ != nullptr ? garment_faces(*grid_, garment_->texture) : image_faces(*grid_);
}

std::vector<Vec3f> ExportedSurface::colours() const {
  std::vector<Vec3f> colours;
  if (image_ == nullptr || !image_->has_colours()) return colours;
  colours.reserve(grid_->sample_of.size());
  for (const int sample : grid_->sample_of) colours.push_back(image_->colours.at(sample));
  return colours;
}

GarmentParts ExportedSurface::parts() const {
  GarmentParts parts;
  if (garment_ == nullptr) return parts;
  parts.panels = panels_of(*grid_, garment_->image.mates);
  for (const GarmentSeam& seam : garment_->seams) parts.seams.push_back(seam_line(*grid_, seam));
  return parts;
}

std::vector<Vec3f> ExportedSurface::points(const Planes3& samples) const {
  std::vector<Vec3f> points;
  if (bound_) {
    for (const Vec3d& p : bound_->follow(samples))
      points.push_back(vec_cast<float>(in_frame(p, files_)));
  } else {
    points = grid_->gather(samples);
    if (garment_ != nullptr) join_sewn(*grid_, garment_->sewn, samples, points);
    for (Vec3f& p : points) p = vec_cast<float>(in_frame(vec_cast<double>(p), files_));
  }
  return points;
}

}  // namespace weft
