#include "weft/cloth/kernels/isa/dot.h"
#include "weft/cloth/kernels/isa/rows.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

struct Sum3 {
  float x, y, z;
};

/// sum += B v
inline void add(const BlockRow6& block, int c, ConstRow3 v, int shift, Sum3& sum) {
  const float x = v.x[c + shift], y = v.y[c + shift], z = v.z[c + shift];
  const float xy = block.entry[1][c], xz = block.entry[2][c], yz = block.entry[4][c];
  sum.x += block.entry[0][c] * x + xy * y + xz * z;
  sum.y += xy * x + block.entry[3][c] * y + yz * z;
  sum.z += xz * x + yz * y + block.entry[5][c] * z;
}

}  // namespace

void apply_block_stencil(int n, const BlockStencilRow& row, const RowTriple& x, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    Sum3 sum{0, 0, 0};
    add(row.centre, c, x.here, 0, sum);
    add(row.right, c, x.here, 1, sum);
    add(row.left, c, x.here, -1, sum);
    out.x[c] = sum.x;
    out.y[c] = sum.y;
    out.z[c] = sum.z;
  }
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    Sum3 sum{out.x[c], out.y[c], out.z[c]};
    add(row.below_left, c, x.below, -1, sum);
    add(row.below, c, x.below, 0, sum);
    add(row.below_right, c, x.below, 1, sum);
    out.x[c] = sum.x;
    out.y[c] = sum.y;
    out.z[c] = sum.z;
  }
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    Sum3 sum{out.x[c], out.y[c], out.z[c]};
    add(row.above_right, c, x.above, 1, sum);
    add(row.above, c, x.above, 0, sum);
    add(row.above_left, c, x.above, -1, sum);
    out.x[c] = sum.x;
    out.y[c] = sum.y;
    out.z[c] = sum.z;
  }
}

void add_block_row(int n, const BlockRow6& blocks, ConstRow3 x, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    Sum3 sum{out.x[c], out.y[c], out.z[c]};
    add(blocks, c, x, 0, sum);
    out.x[c] = sum.x;
    out.y[c] = sum.y;
    out.z[c] = sum.z;
  }
}

void coarsen_columns(int m, const StencilBlocks& fine, const MutableStencilBlocks& half) {
  for (int k = 0; k < 6; ++k) {
    const float *centre = fine.centre.entry[k], *right = fine.right.entry[k];
    float *half_centre = half.centre.entry[k], *half_right = half.right.entry[k];
#pragma omp simd
    for (int q = 0; q < m; ++q) {
      const int c = 2 * q;
      half_centre[q] =
          centre[c] + right[c] + right[c - 1] + 0.25F * (centre[c - 1] + centre[c + 1]);
      half_right[q] = 0.5F * (right[c] + right[c + 1]) + 0.25F * centre[c + 1];
    }
    const float *below_left = fine.below_left.entry[k], *below = fine.below.entry[k],
                *below_right = fine.below_right.entry[k];
    float *half_left = half.below_left.entry[k], *half_below = half.below.entry[k],
          *half_diagonal = half.below_right.entry[k];
#pragma omp simd
    for (int q = 0; q < m; ++q) {
      const int c = 2 * q;
      half_below[q] =
          below[c] +
          0.5F * (below_right[c] + below_left[c] + below_right[c - 1] + below_left[c + 1]) +
          0.25F * (below[c - 1] + below[c + 1]);
      half_diagonal[q] = 0.5F * (below_right[c] + below_right[c + 1]) + 0.25F * below[c + 1];
      half_left[q] = 0.5F * (below_left[c] + below_left[c - 1]) + 0.25F * below[c - 1];
    }
    // Nothing is beyond the last coarse column, or before the first.
    half_right[m - 1] = half_diagonal[m - 1] = half_left[0] = 0;
  }
}

void coarsen_rows(int m, const StencilBlocks* half, const MutableStencilBlocks& coarse) {
  const StencilBlocks &above = half[0], &here = half[1], &below = half[2];
  for (int k = 0; k < 6; ++k) {
    const float *c0 = here.centre.entry[k], *c1 = below.centre.entry[k],
                *cm = above.centre.entry[k];
    const float *s0 = here.below.entry[k], *s1 = below.below.entry[k], *sm = above.below.entry[k];
    const float *e0 = here.right.entry[k], *e1 = below.right.entry[k], *em = above.right.entry[k];
    const float *a0 = here.below_right.entry[k], *a1 = below.below_right.entry[k],
                *am = above.below_right.entry[k];
    const float *b0 = here.below_left.entry[k], *b1 = below.below_left.entry[k],
                *bm = above.below_left.entry[k];
    float *centre = coarse.centre.entry[k], *right = coarse.right.entry[k];
#pragma omp simd
    for (int q = 0; q < m; ++q) {
      centre[q] = c0[q] + s0[q] + sm[q] + 0.25F * (c1[q] + cm[q]);
      right[q] = e0[q] + 0.5F * (a0[q] + b0[q + 1] + am[q] + bm[q + 1]) + 0.25F * (e1[q] + em[q]);
    }
    float *down = coarse.below.entry[k], *diagonal_right = coarse.below_right.entry[k],
          *diagonal_left = coarse.below_left.entry[k];
#pragma omp simd
    for (int q = 0; q < m; ++q) {
      down[q] = 0.5F * (s0[q] + s1[q]) + 0.25F * c1[q];
      diagonal_right[q] = 0.5F * (a0[q] + a1[q]) + 0.25F * e1[q];
      diagonal_left[q] = 0.5F * (b0[q] + b1[q]) + 0.25F * e1[q - 1];
    }
    right[m - 1] = diagonal_right[m - 1] = diagonal_left[0] = 0;
  }
}

void restrict_row(int n, int m, const RowTriple& fine, float* line, Row3 coarse) {
  const float* const above[3] = {fine.above.x, fine.above.y, fine.above.z};
  const float* const here[3] = {fine.here.x, fine.here.y, fine.here.z};
  const float* const below[3] = {fine.below.x, fine.below.y, fine.below.z};
  float* const out[3] = {coarse.x, coarse.y, coarse.z};
  for (int k = 0; k < 3; ++k) {
    float* sum = line + 1;  // from column -1 to n + 1
#pragma omp simd
    for (int c = -1; c < n + 2; ++c) sum[c] = here[k][c] + 0.5F * (above[k][c] + below[k][c]);
#pragma omp simd
    for (int q = 0; q < m; ++q) out[k][q] = sum[2 * q] + 0.5F * (sum[2 * q - 1] + sum[2 * q + 1]);
  }
}

void prolong_row(int n, ConstRow3 a, ConstRow3 b, float* line, Row3 fine) {
  const float* const first[3] = {a.x, a.y, a.z};
  const float* const second[3] = {b.x, b.y, b.z};
  float* const out[3] = {fine.x, fine.y, fine.z};
  const int pairs = n / 2, m = pairs + 1;
  for (int k = 0; k < 3; ++k) {
#pragma omp simd
    for (int q = 0; q < m; ++q) line[q] = 0.5F * (first[k][q] + second[k][q]);
#pragma omp simd
    for (int q = 0; q < pairs; ++q) {
      out[k][2 * q] += line[q];
      out[k][2 * q + 1] += 0.5F * (line[q] + line[q + 1]);
    }
    if (n % 2 != 0) out[k][n - 1] += line[m - 1];
  }
}

void subtract(int n, ConstRow3 a, ConstRow3 b, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] = a.x[c] - b.x[c];
    out.y[c] = a.y[c] - b.y[c];
    out.z[c] = a.z[c] - b.z[c];
  }
}

void scale_add(int n, ConstRow3 a, float factor, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] = a.x[c] + factor * out.x[c];
    out.y[c] = a.y[c] + factor * out.y[c];
    out.z[c] = a.z[c] + factor * out.z[c];
  }
}

void scale_row(int n, float factor, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] *= factor;
    out.y[c] *= factor;
    out.z[c] *= factor;
  }
}

void add_scaled(int n, float factor, ConstRow3 a, Row3 out) {
#pragma omp simd
  for (int c = 0; c < n; ++c) {
    out.x[c] += factor * a.x[c];
    out.y[c] += factor * a.y[c];
    out.z[c] += factor * a.z[c];
  }
}

double newton_dot(int n, const float* share, ConstRow3 a, ConstRow3 b) {
  return lane_dot(n, share, a, b);
}

float largest(int n, ConstRow3 a) {
  float maximum = 0;
  // The largest is the same in any order.
#pragma omp simd reduction(max : maximum)
  for (int c = 0; c < n; ++c) {
    const float squared = a.x[c] * a.x[c] + a.y[c] * a.y[c] + a.z[c] * a.z[c];
    maximum = squared > maximum ? squared : maximum;
  }
  return maximum;
}

}  // namespace weft::WEFT_KERNEL_SET
