#include "weft/mesh/shapes/box.h"

#include <array>
#include <cmath>

#include "weft/mesh/shapes/patch.h"
#include "weft/repair.h"

namespace weft {
namespace {

constexpr double cell = 0.02;  // [m]
const int across = static_cast<int>(std::lround(box_size.x / cell)),
          up = static_cast<int>(std::lround(box_size.y / cell)),
          deep = static_cast<int>(std::lround(box_size.z / cell));

/// In cells from the box's lowest corner: whole numbers, so that neighbours meet bit for bit.
struct Side {
  Vec3d corner, along_u, along_v;  ///< along_u x along_v points outward
  int cols, rows;
};

void add_side(TriangleMesh& mesh, const Side& side) {
  const TriangleMesh patch =
      patch_mesh({.cols = side.cols, .rows = side.rows}, [&](double u, double v) {
        return side.corner + std::round(u * side.cols) * side.along_u +
               std::round(v * side.rows) * side.along_v;
      });
  const int first = static_cast<int>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), patch.positions.begin(), patch.positions.end());
  for (const Triangle& t : patch.triangles)
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

TriangleMesh box_mesh() {
  const double x = across, y = up, z = deep;
  TriangleMesh sides;
  for (const Side& side : {Side{{x, 0, 0}, {0, 1, 0}, {0, 0, 1}, up, deep},
                           Side{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, deep, up},
                           Side{{0, y, 0}, {0, 0, 1}, {1, 0, 0}, deep, across},
                           Side{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, across, deep},
                           Side{{0, 0, z}, {1, 0, 0}, {0, 1, 0}, across, up},
                           Side{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, up, across}})
    add_side(sides, side);
  TriangleMesh mesh = weld_exact(sides);
  for (Vec3d& p : mesh.positions) p = cell * p - 0.5 * box_size;
  return mesh;
}

}  // namespace weft
