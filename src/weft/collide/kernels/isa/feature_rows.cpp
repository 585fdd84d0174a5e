#include <cmath>

#include "weft/collide/kernels/isa/tiles.h"

// Which features of a cell and of the cells of a tile may touch, in single precision: these
// tests spare the exact ones.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Part of a triangle or an edge that is added to it on all sides, against rounding.
constexpr float hair = 1e-3F;
/// Square of the cosine between two normals from which on cells count as parallel.
constexpr float squared_flat = 0.64F;

/// Least and largest displacement in a step along one axis, of four corners.
struct Spread {
  float least, most;
};
inline Spread spread_of(float a, float b, float c, float d) {
  return {min(min(a, b), min(c, d)), max(max(a, b), max(c, d))};
}
inline Spread spread_of(const float (&start)[4], const float (&end)[4]) {
  return spread_of(end[0] - start[0], end[1] - start[1], end[2] - start[2], end[3] - start[3]);
}
/// @param start  one axis of a tile [4 x 8]
inline Spread lane_spread(const float* start, const float* end, int lane) {
  const auto moved = [&](int i) {
    return end[i * tile_cells + lane] - start[i * tile_cells + lane];
  };
  return spread_of(moved(0), moved(1), moved(2), moved(3));
}
inline float approach_along(Spread a, Spread b) { return max(a.most - b.least, b.most - a.least); }

struct OwnMotion {
  Spread x, y, z;
  Vec origin, normal;
  float squared_normal, farthest;
};
struct Near {
  float all, edges;
};
__attribute__((always_inline)) inline Near near_of(const OwnMotion& own, const TileCorners& tile,
                                                   int lane, float reach, float flat_reach) {
  const float *start = &tile.start[0][0][0], *end = &tile.end[0][0][0];
  constexpr int axis = 4 * tile_cells;
  const float x = approach_along(own.x, lane_spread(start, end, lane));
  const float y = approach_along(own.y, lane_spread(start + axis, end + axis, lane));
  const float z = approach_along(own.z, lane_spread(start + 2 * axis, end + 2 * axis, lane));
  const Quad other = lane_of(start, lane, own.origin), later = lane_of(end, lane, own.origin);
  const float size = max(own.farthest, max(farthest(other), farthest(later)));
  // Once for the approach, once for the distance at the start.
  const float more = std::sqrt(x * x + y * y + z * z) + 2 * rounding * size;
  const Vec normal = normal_of(other);
  const float along = dot(own.normal, normal);
  const bool flat = along * along > squared_flat * own.squared_normal * dot(normal, normal);
  return {reach + more, (flat ? flat_reach : reach) + more};
}

/// How far from a triangle a point may lie: from its plane, and beside it there [m].
struct Reach {
  float along, beside;
};
/// Whether a point lies inside an edge of a triangle, or beside it within a distance.
/// @param inner  the distance from the edge, times its length and the triangle's doubled area
inline bool inside_edge(float inner, Vec edge, float squared_area, float beside) {
  return (inner >= -hair * squared_area) |
         (inner * inner <= beside * beside * squared_area * dot(edge, edge));
}
/// Whether a point, relative to a triangle's first corner, may lie over it or beside that.
__attribute__((always_inline)) inline bool holds(Vec first, Vec second, Vec across,
                                                 float squared_area, Vec from, Reach reach) {
  const float height = dot(across, from);
  const float u = dot(cross(from, second), across), v = dot(cross(first, from), across);
  return (height * height <= reach.along * reach.along * squared_area) &
         inside_edge(u, second, squared_area, reach.beside) &
         inside_edge(v, first, squared_area, reach.beside) &
         inside_edge(squared_area - u - v, second - first, squared_area, reach.beside);
}
inline bool holds(Vec a, Vec b, Vec c, Vec point, Reach reach) {
  const Vec first = b - a, second = c - a, across = cross(first, second);
  return holds(first, second, across, dot(across, across), point - a, reach);
}
inline Vec select(bool first, Vec a, Vec b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}
/// Bits 0 and 1: the two triangles of a cell.
inline int holding(const Quad& cell, bool falling, Vec point, Reach reach) {
  const Vec third = select(falling, cell.c, cell.d), fourth = select(falling, cell.b, cell.a);
  return (holds(cell.a, cell.b, third, point, reach) ? 1 : 0) |
         (holds(fourth, cell.d, cell.c, point, reach) ? 2 : 0);
}

struct Edge {
  Vec origin, along;
  float squared;
};
inline Edge edge_of(Vec from, Vec to) {
  const Vec along = to - from;
  return {from, along, dot(along, along)};
}
inline Edge diagonal_of(const Quad& cell, bool falling) {
  return edge_of(select(falling, cell.b, cell.a), select(falling, cell.c, cell.d));
}
__attribute__((always_inline)) inline bool may_cross(const Edge& p, const Edge& q, float near) {
  const Vec from = p.origin - q.origin;
  const float b = dot(p.along, q.along), d = dot(p.along, from), e = dot(q.along, from);
  const float most = p.squared * q.squared, whole = most - b * b;  // the square of their product
  const float s = b * e - q.squared * d, t = p.squared * e - b * d;
  const float least = -hair * most, end = whole - least;
  const float volume = dot(cross(p.along, q.along), from);
  const bool inside = (s >= least) & (s <= end) & (t >= least) & (t <= end) &
                      (volume * volume <= near * near * whole);
  return inside | !(whole > hair * most);
}

/// Bits 0 to 2: which edges of a tile's cell may cross an edge.
__attribute__((always_inline)) inline int crossing(const Edge& own, Vec origin,
                                                   const TileCorners& tile, int lane, float near) {
  const Quad other = lane_of(&tile.start[0][0][0], lane, origin);
  const Edge diagonal = diagonal_of(other, tile.falling[lane] != 0);
  return (may_cross(own, edge_of(other.a, other.b), near) ? 1 : 0) |
         (may_cross(own, edge_of(other.a, other.c), near) ? 2 : 0) |
         (may_cross(own, diagonal, near) ? 4 : 0);
}

inline int over_lane(const float* start, int lane, bool falling, Vec point, Reach reach) {
  return holding(lane_of(start, lane, point), falling, {0, 0, 0}, reach);
}
inline int over_cell(const Quad& cell, bool falling, Vec origin, const float* start, int lane,
                     Reach reach) {
  const float* x = start + lane;
  return holding(cell, falling, Vec{x[0], x[4 * tile_cells], x[8 * tile_cells]} - origin, reach);
}

inline Vec origin_of(const CellCorners& cell) {
  return {cell.start[0][0], cell.start[1][0], cell.start[2][0]};
}

}  // namespace

void tile_reaches(const CellCorners& cell, const TileCorners& tile, float reach, float flat_reach,
                  float* __restrict near, float* __restrict near_edges) {
  const Vec origin = origin_of(cell);
  const Quad start = quad_of(cell.start, origin), end = quad_of(cell.end, origin);
  const Vec normal = normal_of(start);
  const OwnMotion own{spread_of(cell.start[0], cell.end[0]),
                      spread_of(cell.start[1], cell.end[1]),
                      spread_of(cell.start[2], cell.end[2]),
                      origin,
                      normal,
                      dot(normal, normal),
                      max(farthest(start), farthest(end))};
#pragma omp simd
  for (int k = 0; k < tile_cells; ++k) near[k] = near_of(own, tile, k, reach, flat_reach).all;
#pragma omp simd
  for (int k = 0; k < tile_cells; ++k)
    near_edges[k] = near_of(own, tile, k, reach, flat_reach).edges;
}

void corner_over_tile(const CellCorners& cell, int corner, const TileCorners& tile,
                      const float* near, float beside, int* __restrict out) {
  const Vec point{cell.start[0][corner], cell.start[1][corner], cell.start[2][corner]};
  const float* start = &tile.start[0][0][0];
#pragma omp simd
  for (int k = 0; k < tile_cells; ++k)
    out[k] = over_lane(start, k, tile.falling[k] != 0, point, {near[k], beside});
}

void tile_over_cell(const CellCorners& cell, const TileCorners& tile, int corner, const float* near,
                    float beside, int* __restrict out) {
  const Vec origin = origin_of(cell);
  const Quad own = quad_of(cell.start, origin);
  const bool falling = cell.falling != 0;
  const float* start = tile.start[0][corner];
#pragma omp simd
  for (int k = 0; k < tile_cells; ++k)
    out[k] = over_cell(own, falling, origin, start, k, {near[k], beside});
}

void tile_edges(const CellCorners& cell, const TileCorners& tile, const float* near,
                int* __restrict out) {
  const Vec origin = origin_of(cell);
  const Quad own = quad_of(cell.start, origin);
  const Edge first = edge_of(own.a, own.b), second = edge_of(own.a, own.c),
             third = diagonal_of(own, cell.falling != 0);
#pragma omp simd
  for (int k = 0; k < tile_cells; ++k) out[k] = crossing(first, origin, tile, k, near[k]);
#pragma omp simd
  for (int k = 0; k < tile_cells; ++k) out[k] |= crossing(second, origin, tile, k, near[k]) << 3;
#pragma omp simd
  for (int k = 0; k < tile_cells; ++k) out[k] |= crossing(third, origin, tile, k, near[k]) << 6;
}

}  // namespace weft::WEFT_KERNEL_SET
