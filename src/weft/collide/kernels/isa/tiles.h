#pragma once

#include "weft/collide/kernels/isa/rows.h"

// A cell beside the cells of a tile, one cell a lane. Vectors of three coordinates are values of
// inlined functions only: in the body of a vectorised loop they would become arrays in memory.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Generous bound of the rounding error of a gap, relative to the farthest coordinate.
constexpr float rounding = 4e-6F;

struct Vec {
  float x, y, z;
};
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float absolute(float a) { return a < 0 ? -a : a; }
inline float farthest(Vec a) { return max(max(absolute(a.x), absolute(a.y)), absolute(a.z)); }

/// Four corners at one end of the step, relative to a common origin.
struct Quad {
  Vec a, b, c, d;
};
inline float farthest(const Quad& q) {
  return max(max(farthest(q.a), farthest(q.b)), max(farthest(q.c), farthest(q.d)));
}
inline Vec normal_of(const Quad& q) { return cross(q.b - q.c, q.d - q.a); }
inline Vec sum_of(const Quad& q) {
  return {q.a.x + q.b.x + (q.c.x + q.d.x), q.a.y + q.b.y + (q.c.y + q.d.y),
          q.a.z + q.b.z + (q.c.z + q.d.z)};
}
inline Quad quad_of(const float (&of)[3][4], Vec origin) {
  const auto corner = [&](int i) { return Vec{of[0][i], of[1][i], of[2][i]} - origin; };
  return {corner(0), corner(1), corner(2), corner(3)};
}
/// @param of  corners of a tile [3 x 4 x 8]
inline Quad lane_of(const float* of, int lane, Vec origin) {
  const auto corner = [&](int i) {
    const float* x = of + i * tile_cells + lane;
    return Vec{x[0], x[4 * tile_cells], x[8 * tile_cells]} - origin;
  };
  return {corner(0), corner(1), corner(2), corner(3)};
}

}  // namespace
}  // namespace weft::WEFT_KERNEL_SET
