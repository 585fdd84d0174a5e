#pragma once

#include "weft/mesh/io/gltf_object.h"
#include "weft/vec.h"

namespace weft {

/// How a material lays its picture on a surface: glTF's extension KHR_texture_transform. Texture
/// coordinates are scaled, turned and moved, in this order, with v running downwards; turned so
/// that the picture turns clockwise.
class GltfTextureTransform {
 public:
  /// @throws InputError for what are no finite numbers
  explicit GltfTextureTransform(const GltfObject& extension);

  /// @param uv  with v running upwards, as in surfaces that were read; so is the result
  [[nodiscard]] Vec2f operator()(Vec2f uv) const;

 private:
  Vec2d offset_, scale_{1, 1};
  double sine_ = 0, cosine_ = 1;
};

}  // namespace weft
