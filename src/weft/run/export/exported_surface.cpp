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
  const double steps = grid.size - 1;
  for (int r = 0; r < grid.size; ++r)
    for (int c = 0; c < grid.size; ++c)
      faces.texture.push_back({static_cast<float>(c / steps), static_cast<float>(r / steps)});
  return faces;
}

}  // namespace

ExportedSurface::ExportedSurface(const SurfacePoints& grid, const MeshFrame& files)
    : grid_(&grid), files_(files) {}

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

MeshFaces ExportedSurface::faces() const { return bound_ ? mesh_->faces : grid_faces(*grid_); }

std::vector<Vec3f> ExportedSurface::points(const Planes3& samples) const {
  std::vector<Vec3f> points;
  if (bound_) {
    for (const Vec3d& p : bound_->follow(samples))
      points.push_back(vec_cast<float>(in_frame(p, files_)));
  } else {
    points = grid_->gather(samples);
    for (Vec3f& p : points) p = vec_cast<float>(in_frame(vec_cast<double>(p), files_));
  }
  return points;
}

}  // namespace weft
