#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weft/mesh.h"
#include "weft/mesh/io/coloured_files.h"
#include "weft/mesh/io/gltf_document.h"
#include "weft/mesh/io/gltf_texture_transform.h"

namespace weft {

/// Gathers the colours of primitives: COLOR_0, the base colour and picture of their materials.
class GltfColours {
 public:
  /// @param name  what errors call the file, kept as a view
  GltfColours(GltfDocument& document, std::string_view name) : document_(document), name_(name) {}

  /// @param triangles  of the primitive, in the order in which the surface has them
  /// @param vertices   how many the primitive has
  /// @throws InputError for materials and pictures that are not whole
  void add(const GltfObject& primitive, const GltfObject& attributes,
           const std::vector<Triangle>& triangles, std::size_t vertices);
  SurfaceColours take();

 private:
  struct Material {
    int part = -1;
    int texture_set = 0;                        ///< the n of TEXCOORD_n
    std::optional<GltfTextureTransform> moved = {};  ///< if it is
  };
  Material material_of(const GltfObject& primitive);
  Material read_material(int index);
  static void read_place(const GltfObject& use, Material& material);
  int read_picture(const GltfObject& texture);
  void add_corners(const GltfObject& attributes, const std::vector<Triangle>& triangles,
                   std::size_t vertices);
  void add_texture(const GltfObject& attributes, const Material& material,
                   const std::vector<Triangle>& triangles, std::size_t vertices);

  GltfDocument& document_;
  std::string_view name_;
  SurfaceColours colours_;
  bool any_corners_ = false;
  std::map<int, Material> materials_;  ///< by number
  std::map<int, int> pictures_;        ///< by number of the image
};

}  // namespace weft
