#pragma once

#include <map>
#include <span>
#include <vector>

#include "weft/drawing.h"
#include "weft/view/gl/objects.h"

namespace weft::gl {

/// The same with every not-finite sample replaced by the one before it in row order (at the start:
/// 0).
Planes3 without_holes(const Planes3& planes);

/// Vertex numbers of a list of triangles (or of edges), and how to draw them.
class IndexList {
 public:
  IndexList();
  void upload(std::span<const GLuint> indices);
  [[nodiscard]] GLsizei count() const { return count_; }
  [[nodiscard]] GLuint array() const { return array_.name(); }
  void draw_triangles() const;

 private:
  VertexArray array_;
  Buffer buffer_;
  GLsizei count_ = 0;
};

/// One surface on the graphics side: positions and normals as textures, triangles as vertex
/// numbers. A mesh's vertices are folded into rows of 1024, so that it goes the same way as a grid.
class SurfaceBuffers {
 public:
  /// @return whether anything is new
  bool load(const DrawnSurface& surface);
  /// Whether light was drawn to its targets since they were made.
  [[nodiscard]] bool is_lit() const { return is_lit_; }
  void set_lit() { is_lit_ = true; }
  void load(const DrawnMesh& mesh);
  /// A flat square of the ground, 65 x 65 samples.
  void load_ground(Vec3d centre, double half_side);

  [[nodiscard]] const Texture& positions() const { return positions_; }
  [[nodiscard]] const Texture& normals() const { return normals_; }
  /// Of a grid: what its colour is times; of a mesh: the colour of each vertex.
  [[nodiscard]] const Texture& colours() const { return colours_; }
  [[nodiscard]] const Texture& sky_front() const { return sky_front_; }
  [[nodiscard]] const Texture& sky_back() const { return sky_back_; }
  [[nodiscard]] bool is_grid() const { return grid_side_ > 0; }
  /// What was loaded lies in it; empty when nothing is finite.
  [[nodiscard]] const Box3d& box() const { return box_; }
  /// Draws the triangles. @param step  for a grid: only every so many rows and columns, >= 1
  void draw(int step);
  /// Draws a grid with about so many quads a side, or all where it has fewer; of a mesh, all.
  void draw_about(int quads);
  /// The target that the skylight of every sample is drawn to.
  [[nodiscard]] const Framebuffer& sky_target() const { return sky_target_; }
  /// Binds positions and normals to units 0 and 1 and tells the program how to read them.
  void bind(const Program& program) const;

 private:
  void upload_grid(const Planes3& positions, const Planes3& normals);
  void make_sky_target(int width, int height);

  Texture positions_, normals_, colours_, sky_front_, sky_back_;
  Framebuffer sky_target_;
  std::map<int, IndexList> triangles_;  // by step; made when first drawn
  int grid_side_ = 0;                   // 0: a mesh
  std::uint64_t revision_ = 0;          // of the surface that was loaded
  Box3d box_;
  bool is_lit_ = false;
};

}  // namespace weft::gl
