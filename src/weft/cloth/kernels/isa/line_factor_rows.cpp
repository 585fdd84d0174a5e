#include "weft/cloth/kernels/isa/line_tiles.h"
#include "weft/cloth/kernels/isa/rows.h"

// Factors of the block tridiagonal systems of neighbouring lines, side by side in lanes. Those of
// blocks are computed in double and stored in float: in light, stiff cloth the Schur complements
// are small differences of large blocks. For springs the differences have a closed form without
// cancellation.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// A pivot is at least what the diagonal has beyond the springs, as those alone leave none below 0,
/// and at least this part of its entry. Rounding alone would make small pivots, or negative ones,
/// and what lines pass on would grow from sample to sample.
constexpr double min_pivot = 2e-7;
constexpr float min_series_pivot = 1e-6F;

/// The inverses of the Schur complements, carried from position to position.
template <int lanes>
struct Elimination {
  alignas(64) double inverse[6][lanes] = {};
  alignas(64) double coupling[6][lanes] = {};

  /// inverse = (block - coupling inverse coupling)^-1 by L D L^T.
  /// @param beyond  what the diagonal of the block has beyond springs
  void advance(const double (*block)[lanes], const float* beyond) {
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
      const double own = double{beyond[i]};
      const double part0 = min_pivot * block[0][i], part3 = min_pivot * block[3][i],
                   part5 = min_pivot * block[5][i];
      const double least0 = part0 > own ? part0 : own, least3 = part3 > own ? part3 : own,
                   least5 = part5 > own ? part5 : own;
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

/// Coupling blocks, read from planes.
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

/// Coupling blocks, computed from springs.
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
      // Keeps the systems of lanes without a line regular.
      for (int i = block.width; i < lanes; ++i) tile[6][j][i] = 1;
      for (int k = 0; k < 6; ++k) {
        const bool on_diagonal = k == 0 || k == 3 || k == 5;
#pragma omp simd
        for (int i = 0; i < lanes; ++i)
          here[k][i] = double{tile[k][j][i]} + (on_diagonal ? double{tile[6][j][i]} : 0.0);
      }
      state.advance(here, tile[6][j]);
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

/// The elimination of springs in series, in single precision without cancellation. With Q the
/// diagonal block of a sample without the spring K = t 1 + s s^T to the next one,
/// P = K - K (Q + K)^-1 K is added to the next sample's block.
template <int lanes>
struct Series {
  alignas(64) float passed[6][lanes] = {};  // P

  /// out = (Q + K)^-1 and K. @param held  Q without the P of the spring before
  void advance(const float (*held)[chunk][lanes], const float (*spring)[chunk][lanes], int j,
               float* out) {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const float t = spring[0][j][i], x = spring[1][j][i], y = spring[2][j][i],
                  z = spring[3][j][i];
      const float a0 = held[0][j][i] + passed[0][i] + t, a1 = held[1][j][i] + passed[1][i],
                  a2 = held[2][j][i] + passed[2][i], a3 = held[3][j][i] + passed[3][i] + t,
                  a4 = held[4][j][i] + passed[4][i], a5 = held[5][j][i] + passed[5][i] + t;
      // W = (Q + t 1)^-1 by L D L^T.
      const float i0 = 1 / a0, l1 = a1 * i0, l2 = a2 * i0;
      const float p1 = a3 - l1 * a1, least1 = min_series_pivot * a3;
      const float i1 = 1 / (p1 > least1 ? p1 : least1), e4 = a4 - l1 * a2, m = e4 * i1;
      const float p2 = a5 - l2 * a2 - m * e4, least2 = min_series_pivot * a5;
      const float i2 = 1 / (p2 > least2 ? p2 : least2), n = m * l1 - l2;
      const float w0 = i0 + l1 * l1 * i1 + n * n * i2, w1 = -(l1 * i1 + m * n * i2), w2 = n * i2,
                  w3 = i1 + m * m * i2, w4 = -(m * i2), w5 = i2;
      // (W^-1 + s s^T)^-1 = W - q q^T / (1 + s . q), q = W s.
      const float qx = w0 * x + w1 * y + w2 * z, qy = w1 * x + w3 * y + w4 * z,
                  qz = w2 * x + w4 * y + w5 * z;
      const float part = 1 / (1 + x * qx + y * qy + z * qz);
      const float rx = part * qx, ry = part * qy, rz = part * qz;
      out[i] = w0 - rx * qx;
      out[lanes + i] = w1 - rx * qy;
      out[2 * lanes + i] = w2 - rx * qz;
      out[3 * lanes + i] = w3 - ry * qy;
      out[4 * lanes + i] = w4 - ry * qz;
      out[5 * lanes + i] = w5 - rz * qz;
      out[6 * lanes + i] = t;
      out[7 * lanes + i] = x;
      out[8 * lanes + i] = y;
      out[9 * lanes + i] = z;
      // P = t (1 - t W) + (s - t q) (s - t q)^T / (1 + s . q)
      const float ux = x - t * qx, uy = y - t * qy, uz = z - t * qz, tt = t * t;
      const float vx = part * ux, vy = part * uy, vz = part * uz;
      passed[0][i] = t - tt * w0 + vx * ux;
      passed[1][i] = vx * uy - tt * w1;
      passed[2][i] = vx * uz - tt * w2;
      passed[3][i] = t - tt * w3 + vy * uy;
      passed[4][i] = vy * uz - tt * w4;
      passed[5][i] = t - tt * w5 + vz * uz;
    }
  }
};

template <int lanes>
void factor_series(const LineBlock& block, const HeldLineMatrix& matrix, float* factors) {
  Series<lanes> state;
  alignas(64) float held[6][chunk][lanes] = {}, spring[4][chunk][lanes] = {};
  for (int position = 0; position < block.length; position += chunk) {
    const int count = block.length - position < chunk ? block.length - position : chunk;
    for (int k = 0; k < 6; ++k) read_tile<lanes>(matrix.held[k], block, position, count, held[k]);
    for (int k = 0; k < 4; ++k)
      read_tile<lanes>(matrix.spring[k], block, position, count, spring[k]);
    for (int j = 0; j < count; ++j) {
      // Keeps the systems of lanes without a line regular.
      for (int i = block.width; i < lanes; ++i) held[0][j][i] = held[3][j][i] = held[5][j][i] = 1;
      state.advance(
          held, spring, j,
          factors + static_cast<std::ptrdiff_t>(position + j) * held_factor_entries * lanes);
    }
  }
}

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

void factor_held_lines(const LineBlock& lines, const HeldLineMatrix& matrix, float* factors) {
  if (lines.width > half_lanes)
    factor_series<line_lanes>(lines, matrix, factors);
  else
    factor_series<half_lanes>(lines, matrix, factors);
}

}  // namespace weft::WEFT_KERNEL_SET
