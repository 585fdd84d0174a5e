#pragma once

#include "weft/core/planes.h"
#include "weft/view/gl/objects.h"

namespace weft::viewer {

/// The geometry image on the graphics side: positions as colours, in their own box.
class ImageTexture {
 public:
  /// @param positions  [n x n] [m]
  void load(const Planes3& positions);
  [[nodiscard]] unsigned name() const { return texture_.name(); }

 private:
  gl::Texture texture_;
  std::vector<Vec3f> texels_;
};

}  // namespace weft::viewer
