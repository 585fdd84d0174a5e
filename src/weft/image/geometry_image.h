#pragma once

#include <cstdint>
#include <string>

#include "weft/core/planes.h"
#include "weft/image/border_mates.h"

namespace weft {

/// The similarity from the unit cube to the world: world = lower + scale * cube.
struct WorldMap {
  Vec3d lower;       ///< [m]
  double scale = 1;  ///< [m], > 0
  [[nodiscard]] Vec3d to_world(Vec3f cube) const { return lower + scale * vec_cast<double>(cube); }
};

/// A surface as an n x n picture whose colours are positions. Sample (row, col) lies at v = row, u
/// = col of the square map; dP/du x dP/dv points outwards. A value.
struct GeometryImage {
  Planes3 cube;  ///< [n x n] positions in [0, 1]^3; mates hold equal bits
  BorderMates mates;
  WorldMap world;
  std::string source;       ///< file name (without folder) or builtin:NAME that it was made from
  std::string source_hash;  ///< 16 hexadecimal digits over that mesh, or empty

  [[nodiscard]] int size() const { return cube.size(); }
  [[nodiscard]] Vec3d world_position(int row, int col) const {
    return world.to_world(cube.at(row, col));
  }
};

/// Smallest n of a geometry image.
inline constexpr int min_image_size = 5;
/// Largest n that files are believed.
inline constexpr int largest_image_size = 8193;

/// Unit outward normals, n x n, in the same square as the geometry image they go with; of any size.
struct NormalMap {
  Planes3 normal;
  [[nodiscard]] int size() const { return normal.size(); }
};

/// True when all samples of every class hold the same bits.
bool mates_bit_equal(const GeometryImage& image);

/// Positions in the world, mates again equal.
Planes3 world_positions(const GeometryImage& image);

}  // namespace weft
