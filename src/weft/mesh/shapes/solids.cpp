#include "weft/mesh/shapes/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "weft/mesh/shapes/field.h"
#include "weft/mesh/shapes/patch.h"
#include "weft/mesh/shapes/remesh.h"
#include "weft/repair.h"

namespace weft {

namespace {

constexpr double cell = 0.02;  // [m]
const int across = static_cast<int>(std::lround(box_size.x / cell)),
          up = static_cast<int>(std::lround(box_size.y / cell)),
          deep = static_cast<int>(std::lround(box_size.z / cell));

/// A side of the box in cells from its lowest corner: integers, so that the vertices of adjacent
/// sides are bit-equal.
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

namespace {

/// Unit vertices; the cyclic permutations of (0, +-1, +-golden ratio).
TriangleMesh icosahedron() {
  const double a = 1, b = (1 + std::sqrt(5.0)) / 2;
  TriangleMesh mesh;
  mesh.positions = {{-a, b, 0},  {a, b, 0},  {-a, -b, 0}, {a, -b, 0}, {0, -a, b},  {0, a, b},
                    {0, -a, -b}, {0, a, -b}, {b, 0, -a},  {b, 0, a},  {-b, 0, -a}, {-b, 0, a}};
  for (Vec3d& p : mesh.positions) p = normalized(p);
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return mesh;
}

TriangleMesh split_in_four(TriangleMesh mesh) {
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [entry, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.positions.size()));
    if (is_new) mesh.positions.push_back(normalized(mesh.positions[a] + mesh.positions[b]));
    return entry->second;
  };
  std::vector<Triangle> split;
  split.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    split.insert(split.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(split);
  return mesh;
}

}  // namespace

TriangleMesh icosphere(double radius, int levels) {
  TriangleMesh mesh = icosahedron();
  for (int level = 0; level < levels; ++level) mesh = split_in_four(std::move(mesh));
  for (Vec3d& p : mesh.positions) p = radius * p;
  return mesh;
}
namespace {

constexpr double edge = 0.018;  // [m]

double wanted_edge(Vec3d /*place*/) { return edge; }

/// @param half  half the extent of the shape, whose centre is the origin
TriangleMesh mesh_of(double (*field)(Vec3d), Vec3d half) {
  const Vec3d margin{edge, edge, edge};
  Box3d box;
  box.add(half + margin);
  box.add(-(half + margin));
  return remesh(polygonise(field, box, edge),
                {.surface = field, .cut = {}, .edge_length = wanted_edge});
}

// Struts of the plate are as wide as it is thick, so that each is a round rod.
constexpr double strut = 0.06, hole = 0.05, pitch = 2 * hole + strut;
constexpr double half_cols = 2, half_rows = 1.5;  // holes from the middle one to the last
constexpr double border = hole + strut;           // from the centre of an outer hole to the edge

/// Distance in the plane of the plate from its outline with holes, negative on it.
double outline(double x, double z) {
  const double right = std::abs(x), upward = std::abs(z);
  const double to_col = right - std::min(half_cols, std::round(right / pitch)) * pitch;
  const double to_row = upward - (std::min(1.0, std::floor(upward / pitch)) + 0.5) * pitch;
  const double from_hole = hole - std::sqrt(to_col * to_col + to_row * to_row);
  const double beyond_x = std::max(0.0, right - half_cols * pitch);
  const double beyond_z = std::max(0.0, upward - half_rows * pitch);
  const double from_edge = std::sqrt(beyond_x * beyond_x + beyond_z * beyond_z) - border;
  return std::max(from_hole, from_edge);
}

}  // namespace

double double_torus_field(Vec3d point) {
  constexpr double major = 0.18, minor = 0.075, apart = 0.215, blend = 0.06;
  const auto ring = [&](double centre) {
    const double x = point.x - centre;
    const double from_line = std::sqrt(x * x + point.z * point.z) - major;
    return std::sqrt(from_line * from_line + point.y * point.y) - minor;
  };
  return smooth_min(ring(-apart), ring(apart), blend);
}

double genus20_field(Vec3d point) {
  constexpr double radius = 0.5 * strut;
  const double beyond = std::max(0.0, outline(point.x, point.z) + radius);
  return std::sqrt(beyond * beyond + point.y * point.y) - radius;
}

TriangleMesh double_torus_mesh() { return mesh_of(double_torus_field, {0.47, 0.09, 0.26}); }

TriangleMesh genus20_mesh() {
  return mesh_of(genus20_field,
                 {half_cols * pitch + border, 0.5 * strut, half_rows * pitch + border});
}

}  // namespace weft
