#pragma once

#include <map>
#include <span>
#include <vector>

#include "weft/drawing.h"
#include "weft/view/gl/objects.h"

namespace weft::gl {

/// The planes with every non-finite sample replaced by the previous finite one in row order (0 at
/// the start).
Planes3 without_holes(const Planes3& planes);

/// An index buffer of triangles with its vertex array.
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

/// GPU buffers of one surface: positions, normals and light maps as textures, triangles as vertex
/// indices. The vertices of a mesh are folded into rows of 1024, so that it is drawn the same way
/// as a grid.
class SurfaceBuffers {
 public:
  /// Loads a surface, unless its revision is loaded already. @return whether anything is new
  bool load(const DrawnSurface& surface);
  bool load(const DrawnMesh& mesh);
  /// Whether the light maps were drawn since they were created.
  [[nodiscard]] bool is_lit() const { return is_lit_; }
  void set_lit() { is_lit_ = true; }
  /// Loads a flat square of ground, 65 x 65 samples.
  void load_ground(Vec3d centre, double half_side);

  [[nodiscard]] const Texture& positions() const { return positions_; }
  [[nodiscard]] const Texture& normals() const { return normals_; }
  /// Of a grid: factors on its colour; of a mesh: the colour of each vertex.
  [[nodiscard]] const Texture& colours() const { return colours_; }
  [[nodiscard]] const Texture& sky_front() const { return sky_front_; }
  [[nodiscard]] const Texture& sky_back() const { return sky_back_; }
  [[nodiscard]] bool is_grid() const { return grid_side_ > 0; }
  /// Bounding box of the loaded surface; empty when nothing is finite.
  [[nodiscard]] const Box3d& box() const { return box_; }
  /// Draws the triangles. @param step  for a grid: only every so many rows and columns, >= 1
  void draw(int step);
  /// Draws a grid with at least so many quads a side, or all where it has fewer; a mesh with all
  /// triangles.
  void draw_about(int quads);
  /// Render target of the light maps.
  [[nodiscard]] const Framebuffer& sky_target() const { return sky_target_; }
  /// Binds positions and normals to texture units 0 and 1 and sets the uniforms of a program that
  /// reads them.
  void bind(const Program& program) const;

 private:
  /// How a grid is made of triangles.
  struct Triangulation {
    std::vector<Chart> charts;
    std::vector<char> rising;  // see DrawnSurface; empty: in turn
    friend bool operator==(const Triangulation&, const Triangulation&) = default;
  };
  void upload_grid(const Planes3& positions, const Planes3& normals, Triangulation split);
  [[nodiscard]] std::vector<GLuint> quad_triangles(int step) const;
  void make_sky_target(int width, int height);

  Texture positions_, normals_, colours_, sky_front_, sky_back_;
  Framebuffer sky_target_;
  std::map<int, IndexList> triangles_;  // by step; created when first drawn
  int grid_side_ = 0;                   // 0: a mesh
  Triangulation split_;                 // of a grid
  std::uint64_t revision_ = 0;          // of the surface that was loaded
  Box3d box_;
  bool is_lit_ = false;
};

}  // namespace weft::gl
