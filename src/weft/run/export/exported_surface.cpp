#include "weft/run/export/exported_surface.h"

namespace weft {
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
