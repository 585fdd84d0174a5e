#include <cmath>

#include "weft/collide/kernels/isa/tiles.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// 1 << k, which not every instruction set computes for all lanes at once.
constexpr unsigned bit[tile_cells]{1, 2, 4, 8, 16, 32, 64, 128};

/// Extent of a cell along a direction, at one end of the step.
struct Reach {
  float lower, upper;
};
inline Reach along(Vec n, const Quad& q) {
  const float a = dot(n, q.a), b = dot(n, q.b), c = dot(n, q.c), d = dot(n, q.d);
  return {min(min(a, b), min(c, d)), max(max(a, b), max(c, d))};
}
struct Reaches {
  Reach start, end;
};
struct MovingQuad {
  Quad start, end;
};
inline Reaches along(Vec n, const MovingQuad& q) { return {along(n, q.start), along(n, q.end)}; }

struct Wanted {
  float at_start, at_end;
};
/// By how much two cells keep farther apart along a direction than is wanted.
inline float excess(Vec n, const Reaches& a, const Reaches& b, Wanted wanted) {
  const float size = std::sqrt(dot(n, n));
  const float start = size * wanted.at_start, end = size * wanted.at_end;
  const float above = min(a.start.lower - b.start.upper - start, a.end.lower - b.end.upper - end);
  const float below = min(b.start.lower - a.start.upper - start, b.end.lower - a.end.upper - end);
  return size > 0 ? max(above, below) / size : -max(wanted.at_start, wanted.at_end);
}

/// What all lanes need to know of the one cell.
struct Own {
  Vec origin;
  MovingQuad corners;
  Vec normal, sum;
  Reaches along_normal;
  float farthest;
};
inline Own own_of(const CellCorners& cell) {
  const Vec origin{cell.start[0][0], cell.start[1][0], cell.start[2][0]};
  const MovingQuad corners{quad_of(cell.start, origin), quad_of(cell.end, origin)};
  const Vec normal = normal_of(corners.start);
  return {origin,
          corners,
          normal,
          sum_of(corners.start),
          along(normal, corners),
          max(farthest(corners.start), farthest(corners.end))};
}

inline float gap_of(const Own& own, const TileCorners& tile, int lane, Wanted wanted) {
  const MovingQuad other{lane_of(&tile.start[0][0][0], lane, own.origin),
                         lane_of(&tile.end[0][0][0], lane, own.origin)};
  const Vec normal = normal_of(other.start), between = own.sum - sum_of(other.start);
  const float layers =
      max(excess(own.normal, own.along_normal, along(own.normal, other), wanted),
          excess(normal, along(normal, own.corners), along(normal, other), wanted));
  const float beside = excess(between, along(between, own.corners), along(between, other), wanted);
  const float size = max(own.farthest, max(farthest(other.start), farthest(other.end)));
  return max(layers, beside) - rounding * size;
}

/// Gap of a node and a tile's cell along one axis: in either order the smaller one of both ends of
/// the step, of both orders the larger one.
inline float gap_along(const PathBox& a, const TileBoxes& b, int axis, int lane) {
  const float above = min(a.lower_start[axis] - b.upper_start[axis][lane],
                          a.lower_end[axis] - b.upper_end[axis][lane]);
  const float below = min(b.lower_start[axis][lane] - a.upper_start[axis],
                          b.lower_end[axis][lane] - a.upper_end[axis]);
  return max(above, below);
}

}  // namespace

void near_cells(const PatchBoxes& patch, const TileBoxes& tile, float reach,
                unsigned* __restrict out) {
  for (int i = 0; i < patch_cells; ++i) {
    const PathBox& cell = patch.cells[i];
    unsigned found = 0;
#pragma omp simd reduction(| : found)
    for (int k = 0; k < tile_cells; ++k) {
      const float gap = max(max(gap_along(cell, tile, 0, k), gap_along(cell, tile, 1, k)),
                            gap_along(cell, tile, 2, k));
      found |= gap <= reach ? bit[k] : 0;
    }
    out[i] = found;
  }
}

void tile_gaps(const CellCorners& cell, const TileCorners& tile, float at_start, float at_end,
               float* __restrict out) {
  const Own own = own_of(cell);
  const Wanted wanted{at_start, at_end};
#pragma omp simd
  for (int k = 0; k < tile_cells; ++k) out[k] = gap_of(own, tile, k, wanted);
}

}  // namespace weft::WEFT_KERNEL_SET
