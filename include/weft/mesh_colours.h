#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/vec.h"

namespace weft {

/// A picture on a surface: 8-bit sRGB, rows from the top.
struct TexturePicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< [height * width * 3]
};

/// The colours of a mesh: of each triangle the base colour of its part, times those of its corners,
/// times its part's picture at its texture coordinates. Linear RGB, 0 to 1.
struct SurfaceColours {
  struct Part {
    Vec3f base{1, 1, 1};
    int picture = -1;      ///< -1: none
    bool clamped = false;  ///< the picture's border goes on outside of it; else it repeats
  };
  std::vector<Part> parts;
  std::vector<TexturePicture> pictures;
  std::vector<std::filesystem::path> files;   ///< that pictures were read from
  std::vector<int> part_of;                   ///< [F] a part, -1: white
  std::vector<std::array<Vec3f, 3>> corners;  ///< [F], or empty: white
  std::vector<std::array<Vec2f, 3>> uv;  ///< [F] v runs upwards; not finite where a corner has none

  /// The colour at a point of a triangle. @param weights  barycentric, of its corners in order
  [[nodiscard]] Vec3f at(int triangle, const std::array<double, 3>& weights) const;
};

/// The colours of a mesh file: vertex colours of PLY, OBJ and glTF, and the base colours and
/// pictures (PNG, JPEG) of OBJ's materials, of glTF's, and of a PLY that names one. Triangles are
/// those of read_mesh, in its order. Pictures lie in the mesh's folder, below it or in the file.
/// @throws as read_mesh; InputError for a file without colours, of another format, or whose
///         materials or pictures cannot be read
SurfaceColours read_colours(const std::filesystem::path& path);

/// Display values of sRGB in [0, 1], from outside of which they are clamped, as linear light.
Vec3f linear_colour(Vec3f display);
/// Linear light as display values of sRGB, in steps of 1/255.
Vec3f display_colour(Vec3f linear);
/// Linear light as sRGB in whole numbers from 0 to 255, the nearest ones.
std::array<std::uint8_t, 3> display_bytes(Vec3f linear);

}  // namespace weft
