#pragma once

#include <vector>

#include "weft/drawing.h"
#include "weft/view/gl/lights.h"
#include "weft/view/gl/objects.h"
#include "weft/view/gl/surface_buffers.h"

namespace weft::gl {

/// The framebuffer that a scene is painted to.
struct Target {
  GLuint framebuffer = 0;  ///< with colour and depth
  int width = 0, height = 0;
};

/// Paints scenes with whatever OpenGL 3.3 context is current: the one renderer behind files and
/// windows. Passes: depth maps of the key light and of the sky directions; light maps of all
/// surfaces; the picture.
class ScenePainter {
 public:
  /// @throws Error when the driver refuses a shader
  ScenePainter();
  void paint(const DrawnScene& scene, const Target& target);

 private:
  void load(const DrawnScene& scene);
  void renew_light(const DrawnScene& scene);
  /// Loads the part of the ground that shadows may fall on.
  void load_floor(double ground);
  void draw_key_depth();
  void draw_sky_depth();
  /// @param blur  radius of the sky's shadows, in widths of the scene
  void draw_skylight(const SurfaceBuffers& surface, const Program& program, float blur);
  void draw_picture(const DrawnScene& scene, const Target& target);
  void draw_surfaces(const DrawnScene& scene, const Matrix& to_clip, const Target& target);
  void draw_lit(SurfaceBuffers& surface, const Program& program, const Target& target);
  void draw_ground(const Matrix& to_clip);
  void draw_edges(const DrawnScene& scene, const Matrix& to_clip, const Target& target);
  void set_lighting(const Program& program) const;

  Program depth_, skylight_, floor_light_, backdrop_, surface_, mesh_, ground_, edge_;
  Texture key_depth_;
  Framebuffer key_target_;
  DepthLayers sky_depth_;
  Sampler compare_, plain_;
  VertexArray nothing_;  // for vertices made from their index alone
  VertexArray edge_array_;
  Buffer edge_ends_;
  Lights lights_;
  std::vector<SurfaceBuffers> surfaces_;  // surfaces of the scene, then its meshes
  SurfaceBuffers floor_;
  KeyLight key_light_;                   // light of the current light maps
  std::optional<double> ground_height_;  // ground height of the current light maps
  bool is_light_old_ = true;             // a change since the light maps were drawn
};

}  // namespace weft::gl
