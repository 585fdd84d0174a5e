#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/mesh/triangle_mesh.h"
#include "weft/view/legend.h"
#include "weft/view/picture.h"
#include "weft/view/renderer.h"

namespace weft {

/// A curve on a surface, drawn as a round tube.
struct DrawnCurve {
  std::vector<Vec3d> points;  ///< [m]
  Vec3f colour;               ///< display space
};

/// A mesh with what is shown on it. The mesh must outlive the drawing.
struct SurfaceDrawing {
  const TriangleMesh* mesh = nullptr;
  std::vector<Vec3f> colours;  ///< of each vertex, display space; none: plaster
  std::vector<DrawnCurve> curves;
  std::vector<Vec3d> nodes;     ///< drawn as dark balls
  double curve_radius = 0.005;  ///< in diagonals of the mesh's box
  std::optional<Legend> legend;
  bool show_edges = false;
  bool on_white = false;
};

struct ViewFrom {
  int width = 1280, height = 720;           ///< pixels
  double azimuth = 0.45, elevation = 0.25;  ///< of the eye [rad]; azimuth 0 looks from +z
};

/// A round tube along a curve; empty for fewer than two points.
TriangleMesh tube(std::span<const Vec3d> points, double radius);

/// Pictures of a drawing, all of the view's size, legend included.
class SurfacePainter {
 public:
  /// @throws Error as Renderer
  SurfacePainter(const SurfaceDrawing& drawing, const ViewFrom& view);
  Picture draw(const Camera& camera);
  /// Width over height of what a camera sees: the picture without its legend.
  [[nodiscard]] double aspect() const;

 private:
  SurfaceDrawing drawing_;
  TriangleMesh marks_;  // tubes and balls
  DrawnScene scene_;
  std::array<int, 2> size_;  // without the legend
  Renderer renderer_;
};

/// The drawing seen once, its whole mesh in the picture.
Picture draw_surface(const SurfaceDrawing& drawing, const ViewFrom& view);
/// The same on white paper, as figures show surfaces.
Picture draw_on_white(SurfaceDrawing drawing, const ViewFrom& view);

}  // namespace weft
