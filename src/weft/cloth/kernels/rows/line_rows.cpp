#include "weft/cloth/kernels/rows/newton_rows.h"

// Block tridiagonal systems of neighbouring lines, side by side in lanes. Factors are computed in
// double and stored in float: light, stiff cloth leaves the Schur complements a small difference of
// large blocks.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Positions that are read at a time.
constexpr int chunk = 16;
/// A pivot is at least this part of its diagonal entry, so that rounding never makes one negative.
constexpr double least_pivot = 2e-7;

/// Element j of line i becomes tile[j][i].
template <int lanes>
inline void read_tile(const PlaneView& plane, const LineBlock& block, int position, int count,
                      float (*tile)[lanes]) {
  const int width = block.width;
  if (block.along_rows) {
    for (int i = 0; i < width; ++i) {
      const float* line = plane.base + (block.first + i) * plane.stride + position;
      for (int j = 0; j < chunk; ++j) tile[j][i] = line[j];
    }
    return;
  }
  for (int j = 0; j < count; ++j) {
    const float* line = plane.base + (position + j) * plane.stride + block.first;
    if (width == lanes) {
#pragma omp simd
      for (int i = 0; i < lanes; ++i) tile[j][i] = line[i];
    } else {
      for (int i = 0; i < width; ++i) tile[j][i] = line[i];
    }
  }
}

template <int lanes>
inline void write_tile(const MutablePlaneView& plane, const LineBlock& block, int position,
                       int count, const float (*tile)[lanes], bool add) {
  const int width = block.width;
  if (block.along_rows) {
    for (int i = 0; i < width; ++i) {
      float* line = plane.base + (block.first + i) * plane.stride + position;
      if (add)
        for (int j = 0; j < count; ++j) line[j] += tile[j][i];
      else
        for (int j = 0; j < count; ++j) line[j] = tile[j][i];
    }
    return;
  }
  for (int j = 0; j < count; ++j) {
    float* line = plane.base + (position + j) * plane.stride + block.first;
    if (add)
      for (int i = 0; i < width; ++i) line[i] += tile[j][i];
    else
      for (int i = 0; i < width; ++i) line[i] = tile[j][i];
  }
}

/// The inverses of the Schur complements, carried from position to position.
template <int lanes>
struct Elimination {
  alignas(64) double inverse[6][lanes] = {};
  alignas(64) double coupling[6][lanes] = {};

  /// inverse = (block - coupling inverse coupling)^-1 by L D L^T.
  void advance(const double (*block)[lanes]) {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const double o0 = coupling[0][i], o1 = coupling[1][i], o2 = coupling[2][i],
                   o3 = coupling[3][i], o4 = coupling[4][i], o5 = coupling[5][i];
      const double g0 = inverse[0][i], g1 = inverse[1][i], g2 = inverse[2][i], g3 = inverse[3][i],
                   g4 = inverse[4][i], g5 = inverse[5][i];
      const double h00 = g0 * o0 + g1 * o1 + g2 * o2, h01 = g0 * o1 + g1 * o3 + g2 * o4,
                   h02 = g0 * o2 + g1 * o4 + g2 * o5;
      const double h10 = g1 * o0 + g3 * o1 + g4 * o2, h11 = g1 * o1 + g3 * o3 + g4 * o4,
                   h12 = g1 * o2 + g3 * o4 + g4 * o5;
      const double h20 = g2 * o0 + g4 * o1 + g5 * o2, h21 = g2 * o1 + g4 * o3 + g5 * o4,
                   h22 = g2 * o2 + g4 * o4 + g5 * o5;
      const double a0 = block[0][i] - (o0 * h00 + o1 * h10 + o2 * h20);
      const double a1 = block[1][i] - (o0 * h01 + o1 * h11 + o2 * h21);
      const double a2 = block[2][i] - (o0 * h02 + o1 * h12 + o2 * h22);
      const double a3 = block[3][i] - (o1 * h01 + o3 * h11 + o4 * h21);
      const double a4 = block[4][i] - (o1 * h02 + o3 * h12 + o4 * h22);
      const double a5 = block[5][i] - (o2 * h02 + o4 * h12 + o5 * h22);
      const double least0 = least_pivot * block[0][i], least3 = least_pivot * block[3][i],
                   least5 = least_pivot * block[5][i];
      const double d0 = a0 > least0 ? a0 : least0;
      const double i0 = 1 / d0, l1 = a1 * i0, l2 = a2 * i0;
      const double p1 = a3 - l1 * a1, d1 = p1 > least3 ? p1 : least3;
      const double i1 = 1 / d1, e4 = a4 - l1 * a2, m = e4 * i1;
      const double p2 = a5 - l2 * a2 - m * e4, d2 = p2 > least5 ? p2 : least5;
      const double i2 = 1 / d2, p = l1 * m - l2;
      inverse[0][i] = i0 + l1 * l1 * i1 + p * p * i2;
      inverse[1][i] = -l1 * i1 - p * m * i2;
      inverse[2][i] = p * i2;
      inverse[3][i] = i1 + m * m * i2;
      inverse[4][i] = -m * i2;
      inverse[5][i] = i2;
    }
  }
};

/// Reads coupling blocks as they are.
template <int lanes>
struct BlockCoupling {
  const PlaneView* planes;
  alignas(64) float tile[6][chunk][lanes] = {};
  void read(const LineBlock& block, int position, int count) {
    for (int k = 0; k < 6; ++k) read_tile<lanes>(planes[k], block, position, count, tile[k]);
  }
  void at(int j, float (*out)[lanes]) const {
    for (int k = 0; k < 6; ++k)
#pragma omp simd
      for (int i = 0; i < lanes; ++i) out[k][i] = tile[k][j][i];
  }
};

/// Makes them of springs.
template <int lanes>
struct SpringCoupling {
  const PlaneView* planes;
  alignas(64) float tile[4][chunk][lanes] = {};
  void read(const LineBlock& block, int position, int count) {
    for (int k = 0; k < 4; ++k) read_tile<lanes>(planes[k], block, position, count, tile[k]);
  }
  void at(int j, float (*out)[lanes]) const {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const float t = tile[0][j][i], x = tile[1][j][i], y = tile[2][j][i], z = tile[3][j][i];
      out[0][i] = -(t + x * x);
      out[1][i] = -(x * y);
      out[2][i] = -(x * z);
      out[3][i] = -(t + y * y);
      out[4][i] = -(y * z);
      out[5][i] = -(t + z * z);
    }
  }
};

template <int lanes, class Coupling>
void factor(const LineBlock& block, const PlaneView* diagonal, const PlaneView& extra,
            Coupling& coupling, float* factors) {
  Elimination<lanes> state;
  alignas(64) float tile[7][chunk][lanes] = {};
  alignas(64) double here[6][lanes];
  alignas(64) float next[6][lanes];
  for (int position = 0; position < block.length; position += chunk) {
    const int count = block.length - position < chunk ? block.length - position : chunk;
    for (int k = 0; k < 6; ++k) read_tile<lanes>(diagonal[k], block, position, count, tile[k]);
    read_tile<lanes>(extra, block, position, count, tile[6]);
    coupling.read(block, position, count);
    for (int j = 0; j < count; ++j) {
      // Lanes without a line solve for nothing.
      for (int i = block.width; i < lanes; ++i) tile[6][j][i] = 1;
      for (int k = 0; k < 6; ++k) {
        const bool on_diagonal = k == 0 || k == 3 || k == 5;
#pragma omp simd
        for (int i = 0; i < lanes; ++i)
          here[k][i] = double{tile[k][j][i]} + (on_diagonal ? double{tile[6][j][i]} : 0.0);
      }
      state.advance(here);
      coupling.at(j, next);
      float* out =
          factors + static_cast<std::ptrdiff_t>(position + j) * line_factor_entries * lanes;
      for (int k = 0; k < 6; ++k)
#pragma omp simd
        for (int i = 0; i < lanes; ++i) {
          out[k * lanes + i] = static_cast<float>(state.inverse[k][i]);
          out[(6 + k) * lanes + i] = next[k][i];
          state.coupling[k][i] = double{next[k][i]};
        }
    }
  }
}

/// out = base + sign G v for the blocks of a position
template <int lanes>
inline void multiply(const float* blocks, const float (*v)[lanes], float (*out)[lanes]) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    const float x = v[0][i], y = v[1][i], z = v[2][i];
    const float xy = blocks[lanes + i], xz = blocks[2 * lanes + i], yz = blocks[4 * lanes + i];
    out[0][i] = blocks[i] * x + xy * y + xz * z;
    out[1][i] = xy * x + blocks[3 * lanes + i] * y + yz * z;
    out[2][i] = xz * x + yz * y + blocks[5 * lanes + i] * z;
  }
}

template <int lanes>
void solve(const LineBlock& block, const float* factors, const PlaneView* rhs, float scale,
           bool add, float* scratch, const MutablePlaneView* out) {
  using Vectors = float(*)[lanes];
  constexpr std::ptrdiff_t entries = std::ptrdiff_t{line_factor_entries} * lanes;
  alignas(64) float tile[3][chunk][lanes] = {};
  alignas(64) float passed[3][lanes] = {}, right[3][lanes];
  for (int position = 0; position < block.length; position += chunk) {
    const int count = block.length - position < chunk ? block.length - position : chunk;
    for (int k = 0; k < 3; ++k) read_tile<lanes>(rhs[k], block, position, count, tile[k]);
    for (int j = 0; j < count; ++j) {
      const std::ptrdiff_t p = position + j;
      const float* blocks = factors + p * entries;
      const auto here = reinterpret_cast<Vectors>(scratch + p * 3 * lanes);
      for (int k = 0; k < 3; ++k)
#pragma omp simd
        for (int i = 0; i < lanes; ++i) right[k][i] = tile[k][j][i] - passed[k][i];
      multiply<lanes>(blocks, right, here);
      multiply<lanes>(blocks + 6 * lanes, here, passed);
    }
  }
  alignas(64) float later[3][lanes] = {}, pulled[3][lanes];
  const int last = (block.length - 1) / chunk * chunk;
  for (int position = last; position >= 0; position -= chunk) {
    const int count = block.length - position < chunk ? block.length - position : chunk;
    for (int j = count - 1; j >= 0; --j) {
      const std::ptrdiff_t p = position + j;
      const float* blocks = factors + p * entries;
      const auto here = reinterpret_cast<Vectors>(scratch + p * 3 * lanes);
      multiply<lanes>(blocks + 6 * lanes, later, passed);
      multiply<lanes>(blocks, passed, pulled);
      for (int k = 0; k < 3; ++k)
#pragma omp simd
        for (int i = 0; i < lanes; ++i) {
          later[k][i] = here[k][i] - pulled[k][i];
          tile[k][j][i] = scale * later[k][i];
        }
    }
    for (int k = 0; k < 3; ++k) write_tile<lanes>(out[k], block, position, count, tile[k], add);
  }
}

constexpr int half_lanes = line_lanes / 2;

}  // namespace

void factor_lines(const LineBlock& lines, const LineMatrix& matrix, float* factors) {
  if (lines.width > half_lanes) {
    BlockCoupling<line_lanes> coupling{matrix.coupling};
    factor<line_lanes>(lines, matrix.diagonal, matrix.extra, coupling, factors);
  } else {
    BlockCoupling<half_lanes> coupling{matrix.coupling};
    factor<half_lanes>(lines, matrix.diagonal, matrix.extra, coupling, factors);
  }
}

void factor_spring_lines(const LineBlock& lines, const SpringLineMatrix& matrix, float* factors) {
  if (lines.width > half_lanes) {
    SpringCoupling<line_lanes> coupling{matrix.coupling};
    factor<line_lanes>(lines, matrix.diagonal, matrix.extra, coupling, factors);
  } else {
    SpringCoupling<half_lanes> coupling{matrix.coupling};
    factor<half_lanes>(lines, matrix.diagonal, matrix.extra, coupling, factors);
  }
}

void solve_lines(const LineBlock& lines, const float* factors, const PlaneView* rhs, float scale,
                 bool add, float* scratch, const MutablePlaneView* out) {
  if (lines.width > half_lanes)
    solve<line_lanes>(lines, factors, rhs, scale, add, scratch, out);
  else
    solve<half_lanes>(lines, factors, rhs, scale, add, scratch, out);
}

}  // namespace weft::WEFT_KERNEL_SET
