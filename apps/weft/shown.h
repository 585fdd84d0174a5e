#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/weft/context.h"
#include "apps/weft/shots.h"
#include "weft/convert.h"
#include "weft/drawing.h"

namespace weft::app {

/// What to draw of a mesh or an image.
struct ShownArgs {
  std::string subject, show, against;  ///< against: the mesh that an image's error is measured to
  int size = 0;                        ///< of the conversion, where one is needed; 0: 257
  std::string parameterizer;           ///< empty: stretch
  ViewFrom view;
  bool sized = false;  ///< whether the size of the view was asked for
};

/// What can be shown of a mesh and of an image, the default first.
const std::vector<std::string>& shown_of_meshes();
const std::vector<std::string>& shown_of_images();

/// A mesh, an image or a sewing pattern: a flat picture (colours, mates, map, pattern), or a
/// surface.
class Shown : public Subject {
 public:
  /// Converts where that is needed. @throws UsageError for options that do not fit together;
  /// whatever loading and converting throw
  Shown(const ShownArgs& args, const Context& context);
  [[nodiscard]] bool is_flat() const override { return flat_.width > 0; }
  [[nodiscard]] double aspect() const override { return painter_ ? painter_->aspect() : 1; }
  void add_to(Outline& outline, int frame) const override;
  Picture draw(int frame, const Camera& camera) override;

 private:
  void show_pattern(const ShownArgs& args);
  void show_mesh(const ShownArgs& args, const Context& context);
  void show_cut(const ShownArgs& args, const Context& context, const TriangleMesh& mesh);
  void show_conversion(const ShownArgs& args, const Context& context, const TriangleMesh& mesh);
  void show_image(const ShownArgs& args, const GeometryImage& image);
  void show_error(const GeometryImage& image, const TriangleMesh& mesh);
  void show(SurfaceDrawing drawing, const ViewFrom& view);

  ViewFrom view_;
  Picture flat_;
  SurfaceValues surface_;  // what the painter draws
  std::unique_ptr<SurfacePainter> painter_;
};

}  // namespace weft::app
