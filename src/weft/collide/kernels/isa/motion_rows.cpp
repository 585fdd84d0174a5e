#include <cmath>

#include "weft/collide/kernels/motion_kernels.h"

namespace weft::WEFT_KERNEL_SET {

extern const MotionKernels motion_kernels;

namespace {

inline float min(float a, float b) { return a < b ? a : b; }
inline float max(float a, float b) { return a > b ? a : b; }
inline float dot(float ax, float ay, float az, float bx, float by, float bz) {
  return ax * bx + ay * by + az * bz;
}
inline float length(float x, float y, float z) { return std::sqrt(dot(x, y, z, x, y, z)); }

/// Rounding of approaches, as a part of the length of what is projected on a normal.
constexpr float rounding = 2e-6F;

/// Corners a and b along the first row, d and c along the next one. A rising diagonal makes the
/// triangles a, b, c and a, c, d, a falling one a, b, d and b, c, d.
void cell_areas(int cells, const CellRow& row, const CellAreas& out) {
  const float *ax = row.first[0], *ay = row.first[1], *az = row.first[2];
  const float *dx = row.second[0], *dy = row.second[1], *dz = row.second[2];
  const float *rising = row.rising, *there = row.there;
  float *x0 = out.first[0], *y0 = out.first[1], *z0 = out.first[2], *size0 = out.first[3];
  float *x1 = out.second[0], *y1 = out.second[1], *z1 = out.second[2], *size1 = out.second[3];
#pragma omp simd
  for (int i = 0; i < cells; ++i) {
    const float ux = ax[i + 1] - ax[i], uy = ay[i + 1] - ay[i], uz = az[i + 1] - az[i];
    const float vx = dx[i + 1] - dx[i], vy = dy[i + 1] - dy[i], vz = dz[i + 1] - dz[i];
    const float wx = dx[i] - ax[i], wy = dy[i] - ay[i], wz = dz[i] - az[i];
    const float tx = dx[i + 1] - ax[i + 1], ty = dy[i + 1] - ay[i + 1], tz = dz[i + 1] - az[i + 1];
    const float qx = dx[i + 1] - ax[i], qy = dy[i + 1] - ay[i], qz = dz[i + 1] - az[i];
    // u x (c - a) or u x (d - a), and (c - a) x (d - a) or (c - b) x (d - b), which is v x of it.
    const bool rises = rising[i] > 0;
    const float ex = rises ? qx : wx, ey = rises ? qy : wy, ez = rises ? qz : wz;
    const float fx = rises ? wx : tx, fy = rises ? wy : ty, fz = rises ? wz : tz;
    const float here = there[i];
    const float nx = here * (uy * ez - uz * ey), ny = here * (uz * ex - ux * ez),
                nz = here * (ux * ey - uy * ex);
    const float mx = here * (vy * fz - vz * fy), my = here * (vz * fx - vx * fz),
                mz = here * (vx * fy - vy * fx);
    x0[i] = nx;
    y0[i] = ny;
    z0[i] = nz;
    size0[i] = length(nx, ny, nz);
    x1[i] = mx;
    y1[i] = my;
    z1[i] = mz;
    size1[i] = length(mx, my, mz);
  }
}

/// A sample is corner c or d of the cells before it, a or b of those behind it.
void sum_areas(int n, const AreasAround& around, float* const* out) {
  const float *above = around.rising[0], *below = around.rising[1];
  for (int k = 0; k < 4; ++k) {
    const float *first = around.first[0][k], *second = around.second[0][k];
    const float *next_first = around.first[1][k], *next_second = around.second[1][k];
    float* sum = out[k];
#pragma omp simd
    for (int c = 0; c < n; ++c) {
      // Cell c lies before and behind the sample at [c + 1], cell c - 1 at [c].
      const float as_c = above[c] * first[c] + second[c];
      const float as_d = (1 - above[c + 1]) * first[c + 1] + second[c + 1];
      const float as_b = next_first[c] + (1 - below[c]) * next_second[c];
      const float as_a = next_first[c + 1] + below[c + 1] * next_second[c + 1];
      sum[c] = (as_c + as_d) + (as_b + as_a);
    }
  }
}

void find_normals(int n, float* const* sums) {
  float *x = sums[0], *y = sums[1], *z = sums[2], *slant = sums[3];
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    const float size = slant[c], sum = length(x[c], y[c], z[c]);
    const float scale = sum > 0 ? 1 / sum : 0.0F;
    // The more the triangles tilt, the shorter the sum of their area vectors.
    const float lost = size > 0 ? 1 - sum / size : 0.0F;
    x[c] *= scale;
    y[c] *= scale;
    z[c] *= scale;
    slant[c] = 2 * std::sqrt(2 * max(0, lost));
  }
}

/// One row of a block.
struct MotionRow {
  const float *sx, *sy, *sz, *ex, *ey, *ez, *fx, *fy, *fz, *tx, *ty, *tz, *slant;

  MotionRow(const MotionBlock& block, int row)
      : sx(block.start[0] + row * block.stride),
        sy(block.start[1] + row * block.stride),
        sz(block.start[2] + row * block.stride),
        ex(block.end[0] + row * block.stride),
        ey(block.end[1] + row * block.stride),
        ez(block.end[2] + row * block.stride),
        fx(block.from[0] + row * block.normal_stride),
        fy(block.from[1] + row * block.normal_stride),
        fz(block.from[2] + row * block.normal_stride),
        tx(block.to[0] + row * block.normal_stride),
        ty(block.to[1] + row * block.normal_stride),
        tz(block.to[2] + row * block.normal_stride),
        slant(block.slant + row * block.normal_stride) {}
};

void widen(const float* start, const float* end, int cols, float* lower, float* upper, float* sum) {
#pragma omp simd
  for (int c = 0; c < cols; ++c) {
    lower[c] = min(lower[c], min(start[c], end[c]));
    upper[c] = max(upper[c], max(start[c], end[c]));
    sum[c] += end[c] - start[c];
  }
}

void add_row(const MotionRow& row, int cols, const MotionColumns& out) {
  widen(row.sx, row.ex, cols, out.lower[0], out.upper[0], out.displacement[0]);
  widen(row.sy, row.ey, cols, out.lower[1], out.upper[1], out.displacement[1]);
  widen(row.sz, row.ez, cols, out.lower[2], out.upper[2], out.displacement[2]);
  float *normal_x = out.normal[0], *normal_y = out.normal[1], *normal_z = out.normal[2];
  float *slant = out.slant, *turn = out.turn, *approach = out.approach, *moved = out.moved;
#pragma omp simd
  for (int c = 0; c < cols; ++c) {
    const float nx = 0.5F * (row.fx[c] + row.tx[c]), ny = 0.5F * (row.fy[c] + row.ty[c]),
                nz = 0.5F * (row.fz[c] + row.tz[c]);
    const float dx = row.ex[c] - row.sx[c], dy = row.ey[c] - row.sy[c], dz = row.ez[c] - row.sz[c];
    normal_x[c] += nx;
    normal_y[c] += ny;
    normal_z[c] += nz;
    slant[c] = max(slant[c], row.slant[c]);
    const float tx = row.tx[c] - row.fx[c], ty = row.ty[c] - row.fy[c], tz = row.tz[c] - row.fz[c];
    turn[c] = max(turn[c], dot(tx, ty, tz, tx, ty, tz));
    approach[c] = max(approach[c], std::fabs(dot(nx, ny, nz, dx, dy, dz)));
    moved[c] = max(moved[c], dot(dx, dy, dz, dx, dy, dz));
  }
}

void gather_columns(const MotionBlock& block, const MotionColumns& out) {
  constexpr float far = __builtin_huge_valf();
  for (int c = 0; c < block.cols; ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      out.lower[axis][c] = far;
      out.upper[axis][c] = -far;
      out.displacement[axis][c] = out.normal[axis][c] = 0;
    }
    out.slant[c] = out.turn[c] = out.approach[c] = out.moved[c] = 0;
  }
  for (int r = 0; r < block.rows; ++r) add_row(MotionRow(block, r), block.cols, out);
  for (int c = 0; c < block.cols; ++c) {
    out.turn[c] = std::sqrt(out.turn[c]);
    out.moved[c] = std::sqrt(out.moved[c]);
  }
}

void part_columns(const MotionBlock& block, const float* const* along, const float* const* mean,
                  float* approach, float* apart) {
  const float *along_x = along[0], *along_y = along[1], *along_z = along[2];
  const float *mean_x = mean[0], *mean_y = mean[1], *mean_z = mean[2];
  for (int c = 0; c < block.cols; ++c) approach[c] = apart[c] = 0;
  for (int r = 0; r < block.rows; ++r) {
    const MotionRow row(block, r);
#pragma omp simd
    for (int c = 0; c < block.cols; ++c) {
      const float nx = 0.5F * (row.fx[c] + row.tx[c]), ny = 0.5F * (row.fy[c] + row.ty[c]),
                  nz = 0.5F * (row.fz[c] + row.tz[c]);
      const float dx = row.ex[c] - row.sx[c] - along_x[c], dy = row.ey[c] - row.sy[c] - along_y[c],
                  dz = row.ez[c] - row.sz[c] - along_z[c];
      const float whole = length(dx, dy, dz);
      const float own = std::fabs(dot(nx, ny, nz, dx, dy, dz)) + (row.slant[c] + rounding) * whole;
      approach[c] = max(approach[c], own);
      const float mx = nx - mean_x[c], my = ny - mean_y[c], mz = nz - mean_z[c];
      apart[c] = max(apart[c], dot(mx, my, mz, mx, my, mz));
    }
  }
  for (int c = 0; c < block.cols; ++c) apart[c] = std::sqrt(apart[c]);
}

/// Mask of sixteen boxes that overlap one.
unsigned overlaps(const BoxRows& boxes, int first, const float* lower, const float* upper) {
  const float *lx = boxes.lower[0] + first, *ly = boxes.lower[1] + first,
              *lz = boxes.lower[2] + first;
  const float *hx = boxes.upper[0] + first, *hy = boxes.upper[1] + first,
              *hz = boxes.upper[2] + first;
  const float from_x = lower[0], from_y = lower[1], from_z = lower[2];
  const float to_x = upper[0], to_y = upper[1], to_z = upper[2];
  unsigned found = 0;
#pragma omp simd reduction(| : found)
  for (int k = 0; k < 16; ++k) {
    const float apart =
        max(max(lx[k] - to_x, from_x - hx[k]),
            max(max(ly[k] - to_y, from_y - hy[k]), max(lz[k] - to_z, from_z - hz[k])));
    found |= apart <= 0 ? 1U << static_cast<unsigned>(k) : 0U;
  }
  return found;
}

int find_overlaps(const BoxRows& boxes, const float* lower, const float* upper, float reach,
                  int* found) {
  const float from[3] = {lower[0] - reach, lower[1] - reach, lower[2] - reach};
  const float to[3] = {upper[0] + reach, upper[1] + reach, upper[2] + reach};
  int count = 0;
  for (int first = 0; first < boxes.count; first += 16)
    for (unsigned near = overlaps(boxes, first, from, to); near != 0; near &= near - 1)
      found[count++] = first + __builtin_ctz(near);
  return count;
}

}  // namespace

const MotionKernels motion_kernels{cell_areas,     sum_areas,    find_normals,
                                   gather_columns, part_columns, find_overlaps};

}  // namespace weft::WEFT_KERNEL_SET
