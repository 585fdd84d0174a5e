#pragma once

// Distances of points from the triangles of a leaf. Single precision tells most of them apart; what
// it leaves is for the caller to measure exactly. Each triangle gets a lower bound and an upper
// one, so that rounding hides none.
#include "weft/collide/kernels/isa/body_rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

constexpr int lanes = 8;  // triangles of a leaf

/// The triangles of a leaf, prepared for points: corner p, sides u = q - p, v = r - p, w = r - q.
struct alignas(64) PreparedLeaf {
  float p[3][lanes], u[3][lanes], v[3][lanes], w[3][lanes];
  float per_uu[lanes], per_vv[lanes], per_ww[lanes];  // 1 / squared lengths
  float n[3][lanes];                                  // u x v
  float per_area2[lanes];                             // 1 / its squared length
  // Barycentric coordinates of a = point - p: of q qu (a u) + qv (a v), of r qv (a u) + rv (a v).
  float qu[lanes], qv[lanes], rv[lanes];
  float inner[lanes];     // squared bound of the radius of the inner circle [m^2]
  float farthest[lanes];  // squared length of a up to which the plane tells the distance [m^2]
  float slack[lanes];     // of a squared distance [m^2]
};

/// Bounds of squared distances. [m^2]
struct alignas(32) LeafBounds {
  float lower[lanes], upper[lanes];
};

/// Least height of a triangle over its longest side, squared, for which its plane is well known,
/// and the squared distance over that side's square up to which it is.
constexpr float regular = 1e-3F, close_by = 64;
/// Rounding of barycentric coordinates of such triangles, generously.
constexpr float on_edge = 0.05F;
/// Rounding of squared distances, as a part of them, and as a part of the longest side's square:
/// (d - s)^2 >= (1 - e) d^2 - s^2 / e for a rounding s of the distance d.
constexpr float part_of_distance = 1e-3F, part_of_side = 1e-5F;
/// What a rounding of points, squared, adds to squared distances: as above, twice and more.
constexpr float of_rounding = 2.5e3F;
/// Squares of lengths below this one are taken for it, so that no quotient is infinite. [m^2]
constexpr float no_length = 1e-30F;

/// A box in single precision. [m]
struct Box {
  float lower[3], upper[3];
};

/// Squared distances of a box to those of a node's children.
inline void distances(const Box& box, const BodyNode& node, float* squared) {
#pragma omp simd
  for (int k = 0; k < 16; ++k) {
    const float x = max(max(node.lower[0][k] - box.upper[0], box.lower[0] - node.upper[0][k]), 0);
    const float y = max(max(node.lower[1][k] - box.upper[1], box.lower[1] - node.upper[1][k]), 0);
    const float z = max(max(node.lower[2][k] - box.upper[2], box.lower[2] - node.upper[2][k]), 0);
    squared[k] = x * x + y * y + z * z;
  }
}

/// Mask of those of sixteen within a limit.
inline unsigned within_node(const float* squared, float limit) {
  unsigned found = 0;
#pragma omp simd reduction(| : found)
  for (int k = 0; k < 16; ++k) found |= squared[k] <= limit ? bits[k] : 0U;
  return found;
}

/// The corners of 2 x 2 cells: a and b along the first row, d and c along the next one.
inline void gather(const float* first, long stride, unsigned rising, float* p, float* q, float* r) {
  float a[4], b[4], c[4], d[4];
  for (int k = 0; k < 4; ++k) {
    const float* cell = first + k / 2 * stride + k % 2;
    a[k] = cell[0];
    b[k] = cell[1];
    d[k] = cell[stride];
    c[k] = cell[stride + 1];
  }
  for (int k = 0; k < 4; ++k) {
    const bool rises = (rising & bits[k]) != 0;
    p[k] = a[k];
    q[k] = b[k];
    r[k] = rises ? c[k] : d[k];
    p[k + 4] = rises ? a[k] : b[k];
    q[k + 4] = c[k];
    r[k + 4] = d[k];
  }
}

inline void find_planes(PreparedLeaf& leaf, unsigned there) {
#pragma omp simd
  for (int k = 0; k < lanes; ++k) {
    const float ux = leaf.u[0][k], uy = leaf.u[1][k], uz = leaf.u[2][k];
    const float vx = leaf.v[0][k], vy = leaf.v[1][k], vz = leaf.v[2][k];
    const float wx = leaf.w[0][k], wy = leaf.w[1][k], wz = leaf.w[2][k];
    const float uu = max(dot(ux, uy, uz, ux, uy, uz), no_length),
                vv = max(dot(vx, vy, vz, vx, vy, vz), no_length),
                ww = max(dot(wx, wy, wz, wx, wy, wz), no_length), uv = dot(ux, uy, uz, vx, vy, vz);
    leaf.per_uu[k] = 1 / uu;
    leaf.per_vv[k] = 1 / vv;
    leaf.per_ww[k] = 1 / ww;
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const float area2 = max(dot(nx, ny, nz, nx, ny, nz), no_length);
    const float per_area2 = 1 / area2, side2 = max(uu, max(vv, ww));
    leaf.n[0][k] = nx;
    leaf.n[1][k] = ny;
    leaf.n[2][k] = nz;
    leaf.per_area2[k] = per_area2;
    leaf.qu[k] = vv * per_area2;
    leaf.qv[k] = -uv * per_area2;
    leaf.rv[k] = uu * per_area2;
    // At most (area / longest side)^2, and a little more.
    leaf.inner[k] = 0.26F * (area2 / side2);
    leaf.farthest[k] = area2 > regular * side2 * side2 ? close_by * side2 : -1.0F;
    leaf.slack[k] = (there & bits[k]) != 0 ? part_of_side * side2 : far_away * far_away;
  }
}

inline void prepare(const BodyTree& tree, int row, int col, PreparedLeaf& leaf) {
  const BodyLeaf cells = tree.leaves[static_cast<long>(row) * tree.leaf_side + col];
  const long first = tree.first_cell(row) * tree.stride + tree.first_cell(col);
  const float* planes[3] = {tree.x + first, tree.y + first, tree.z + first};
  for (int axis = 0; axis < 3; ++axis) {
    float q[lanes], r[lanes];
    float* p = leaf.p[axis];
    gather(planes[axis], tree.stride, cells.rising, p, q, r);
    for (int k = 0; k < lanes; ++k) {
      leaf.u[axis][k] = q[k] - p[k];
      leaf.v[axis][k] = r[k] - p[k];
      leaf.w[axis][k] = r[k] - q[k];
    }
  }
  find_planes(leaf, cells.there);
}

inline float part(float along) {
  const float least = along < 1 ? along : 1.0F;
  return least > 0 ? least : 0.0F;
}

/// The distance is that of the closest edge, or that of the plane where the point is above the
/// inside. Where that is hard to tell the edges alone give bounds: no point of a triangle is
/// farther from them than the radius of its inner circle. Triangles that are not there are far
/// away.
/// @tparam Both  else lower bounds alone
template <bool Both>
inline void bound(const PreparedLeaf& leaf, const float* at, LeafBounds& out) {
  const float x = at[0], y = at[1], z = at[2];
#pragma omp simd
  for (int k = 0; k < lanes; ++k) {
    const float ux = leaf.u[0][k], uy = leaf.u[1][k], uz = leaf.u[2][k];
    const float vx = leaf.v[0][k], vy = leaf.v[1][k], vz = leaf.v[2][k];
    const float wx = leaf.w[0][k], wy = leaf.w[1][k], wz = leaf.w[2][k];
    const float ax = x - leaf.p[0][k], ay = y - leaf.p[1][k], az = z - leaf.p[2][k];
    const float bx = ax - ux, by = ay - uy, bz = az - uz;
    const float au = dot(ax, ay, az, ux, uy, uz), av = dot(ax, ay, az, vx, vy, vz),
                bw = dot(bx, by, bz, wx, wy, wz);
    const float on_u = part(au * leaf.per_uu[k]), on_v = part(av * leaf.per_vv[k]),
                on_w = part(bw * leaf.per_ww[k]);
    const float cx = ax - on_u * ux, cy = ay - on_u * uy, cz = az - on_u * uz;
    const float dx = ax - on_v * vx, dy = ay - on_v * vy, dz = az - on_v * vz;
    const float ex = bx - on_w * wx, ey = by - on_w * wy, ez = bz - on_w * wz;
    const float edges = min(dot(cx, cy, cz, cx, cy, cz),
                            min(dot(dx, dy, dz, dx, dy, dz), dot(ex, ey, ez, ex, ey, ez)));
    const float height = dot(ax, ay, az, leaf.n[0][k], leaf.n[1][k], leaf.n[2][k]);
    const float of_q = leaf.qu[k] * au + leaf.qv[k] * av;
    const float of_r = leaf.qv[k] * au + leaf.rv[k] * av;
    const float least = min(1 - of_q - of_r, min(of_q, of_r));
    const float inside = min(height * height * leaf.per_area2[k], edges);
    const float low = least > -on_edge ? inside : edges;
    const float high = least > on_edge ? inside : edges;
    const float aa = dot(ax, ay, az, ax, ay, az);
    const float farthest = leaf.farthest[k], slack = leaf.slack[k], unclear = edges - leaf.inner[k];
    const float lower = aa < farthest ? low : unclear, upper = aa < farthest ? high : edges;
    const float min_square = (1 - part_of_distance) * lower - slack;
    out.lower[k] = slack < far_away ? min_square : slack;
    if (Both) out.upper[k] = (1 + part_of_distance) * upper + slack;
  }
}

/// Mask of the triangles within a limit.
inline unsigned within(const float* lower, float limit) {
  unsigned found = 0;
#pragma omp simd reduction(| : found)
  for (int k = 0; k < lanes; ++k) found |= lower[k] <= limit ? bits[k] : 0U;
  return found;
}

/// Lowers `others` to the bounds beyond a limit, lane by lane.
inline void pass_by(const float* lower, float limit, float* others) {
#pragma omp simd
  for (int k = 0; k < lanes; ++k) {
    const float before = others[k], now = lower[k];
    others[k] = now > limit ? min(before, now) : before;
  }
}

inline float least_of(const float (&of)[lanes]) {
  float four[4];
  for (int k = 0; k < 4; ++k) four[k] = min(of[k], of[k + 4]);
  return min(min(four[0], four[1]), min(four[2], four[3]));
}

/// The number of a leaf's triangle.
inline int triangle_of(const BodyTree& tree, int row, int col, int k) {
  const int cell =
      (tree.first_cell(row) + k / 2 % 2) * (tree.size - 1) + tree.first_cell(col) + k % 2;
  return 2 * cell + k / 4;
}

/// A node or leaf that is yet to be looked at: its squared distance, and where it is.
struct Waiting {
  float squared;
  unsigned place;
};
/// @param level  -1: a leaf
inline unsigned place_of(int level, int row, int col) {
  return static_cast<unsigned>(level + 1) << 28U | static_cast<unsigned>(row) << 14U |
         static_cast<unsigned>(col);
}
inline int level_of(unsigned place) { return static_cast<int>(place >> 28U) - 1; }
inline int row_of(unsigned place) { return static_cast<int>(place >> 14U & 0x3FFFU); }
inline int col_of(unsigned place) { return static_cast<int>(place & 0x3FFFU); }

}  // namespace
}  // namespace weft::WEFT_KERNEL_SET
