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
template <int Lanes>
struct Elimination {
  alignas(64) double inverse[6][Lanes] = {};
  alignas(64) double coupling[6][Lanes] = {};

  /// inverse = (block - coupling inverse coupling)^-1 by L D L^T.
  /// @param beyond  what the diagonal of the block has beyond springs
  void advance(const double (*block)[Lanes], const float* beyond) {
#pragma omp simd
    for (int i = 0; i < Lanes; ++i) {
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
template <int Lanes>
struct BlockCoupling {
  const PlaneView* planes;
  alignas(64) float tile[6][chunk][Lanes] = {};
  void read(const LineBlock& block, int position, int count) {
    for (int k = 0; k < 6; ++k) read_tile<Lanes>(planes[k], block, position, count, tile[k]);
  }
  void at(int j, float (*out)[Lanes]) const {
    for (int k = 0; k < 6; ++k)
#pragma omp simd
      for (int i = 0; i < Lanes; ++i) out[k][i] = tile[k][j][i];
  }
};

template <int Lanes>
void factor(const LineBlock& block, const LineMatrix& matrix, float* factors) {
  BlockCoupling<Lanes> coupling{matrix.coupling};
  Elimination<Lanes> state;
  alignas(64) float tile[7][chunk][Lanes] = {};
  alignas(64) double here[6][Lanes];
  alignas(64) float next[6][Lanes];
  for (int position = 0; position < block.length; position += chunk) {
    const int count = block.length - position < chunk ? block.length - position : chunk;
    for (int k = 0; k < 6; ++k)
      read_tile<Lanes>(matrix.diagonal[k], block, position, count, tile[k]);
    read_tile<Lanes>(matrix.extra, block, position, count, tile[6]);
    coupling.read(block, position, count);
    for (int j = 0; j < count; ++j) {
      // Keeps the systems of lanes without a line regular.
      for (int i = block.width; i < Lanes; ++i) tile[6][j][i] = 1;
      for (int k = 0; k < 6; ++k) {
        const bool on_diagonal = k == 0 || k == 3 || k == 5;
#pragma omp simd
        for (int i = 0; i < Lanes; ++i)
          here[k][i] = double{tile[k][j][i]} + (on_diagonal ? double{tile[6][j][i]} : 0.0);
      }
      state.advance(here, tile[6][j]);
      coupling.at(j, next);
      float* out =
          factors + static_cast<std::ptrdiff_t>(position + j) * line_factor_entries * Lanes;
      for (int k = 0; k < 6; ++k)
#pragma omp simd
        for (int i = 0; i < Lanes; ++i) {
          out[k * Lanes + i] = static_cast<float>(state.inverse[k][i]);
          out[(6 + k) * Lanes + i] = next[k][i];
          state.coupling[k][i] = double{next[k][i]};
        }
    }
  }
}

/// A symmetric block of a pack of lanes: xx, xy, xz, yy, yz, zz.
struct Block {
  Pack xx, xy, xz, yy, yz, zz;
};
[[gnu::always_inline]] inline Pack3 operator*(const Block& b, const Pack3& v) {
  return {b.xx * v.x + b.xy * v.y + b.xz * v.z, b.xy * v.x + b.yy * v.y + b.yz * v.z,
          b.xz * v.x + b.yz * v.y + b.zz * v.z};
}

/// By L D L^T.
[[gnu::always_inline]] inline Block inverse_of(const Block& a) {
  const Pack min_yy = min_series_pivot * a.yy, min_zz = min_series_pivot * a.zz;
  const Pack i0 = 1 / a.xx, l1 = a.xy * i0, l2 = a.xz * i0;
  const Pack i1 = 1 / larger(a.yy - l1 * a.xy, min_yy), e4 = a.yz - l1 * a.xz, m = e4 * i1;
  const Pack i2 = 1 / larger(a.zz - l2 * a.xz - m * e4, min_zz), n = m * l1 - l2;
  return {i0 + l1 * l1 * i1 + n * n * i2,
          Pack{} - (l1 * i1 + m * n * i2),
          n * i2,
          i1 + m * m * i2,
          Pack{} - m * i2,
          i2};
}

/// The elimination of springs in series, in single precision without cancellation. With Q the
/// diagonal block of a sample without the spring K = t 1 + s s^T to the next one,
/// P = K - K (Q + K)^-1 K is added to the next sample's block.
/// @param block  Q without P; then P  @return (Q + K)^-1
[[gnu::always_inline]] inline Block pass_on(Pack t, const Pack3& s, Block& block) {
  block.xx += t;
  block.yy += t;
  block.zz += t;
  // (W^-1 + s s^T)^-1 = W - q q^T / (1 + s . q), W = (Q + t 1)^-1, q = W s.
  const Block w = inverse_of(block);
  const Pack3 q = w * s;
  const Pack part = 1 / (1 + dot(s, q));
  const Pack3 r = part * q;
  // P = t (1 - t W) + (s - t q) (s - t q)^T / (1 + s . q)
  const Pack3 u = s - t * q, v = part * u;
  const Pack tt = t * t;
  block = {t - tt * w.xx + v.x * u.x, v.x * u.y - tt * w.xy, v.x * u.z - tt * w.xz,
           t - tt * w.yy + v.y * u.y, v.y * u.z - tt * w.yz, t - tt * w.zz + v.z * u.z};
  return {w.xx - r.x * q.x, w.xy - r.x * q.y, w.xz - r.x * q.z,
          w.yy - r.y * q.y, w.yz - r.y * q.z, w.zz - r.z * q.z};
}

/// Lines of springs, with the blocks that their positions pass on.
template <int Lanes>
struct Series {
  alignas(64) float passed[6][Lanes] = {};
  alignas(64) float held[6][chunk][Lanes] = {};
  alignas(64) float spring[4][chunk][Lanes] = {};

  [[gnu::always_inline]] void add_held(int j, int i, Block& block) const {
    block.xx += load(&held[0][j][i]);
    block.xy += load(&held[1][j][i]);
    block.xz += load(&held[2][j][i]);
    block.yy += load(&held[3][j][i]);
    block.yz += load(&held[4][j][i]);
    block.zz += load(&held[5][j][i]);
  }

  /// Packs that are worked on in turn: a lone one would wait for its own results.
  static constexpr int packs = Lanes / width < 2 ? Lanes / width : 2;

  [[gnu::always_inline]] void advance_one(int j, int i, Block& block, float* out) const {
    const Pack t = load(&spring[0][j][i]);
    const Pack3 s{load(&spring[1][j][i]), load(&spring[2][j][i]), load(&spring[3][j][i])};
    add_held(j, i, block);
    const Block inverse = pass_on(t, s, block);
    const Pack values[held_factor_entries] = {
        inverse.xx, inverse.xy, inverse.xz, inverse.yy, inverse.yz, inverse.zz, t, s.x, s.y, s.z};
    for (int k = 0; k < held_factor_entries; ++k) store(values[k], out + k * Lanes + i);
  }
  [[gnu::always_inline]] Block passed_to(int i) const {
    return {load(&passed[0][i]), load(&passed[1][i]), load(&passed[2][i]),
            load(&passed[3][i]), load(&passed[4][i]), load(&passed[5][i])};
  }
  [[gnu::always_inline]] void pass(const Block& block, int i) {
    const Pack values[6] = {block.xx, block.xy, block.xz, block.yy, block.yz, block.zz};
    for (int k = 0; k < 6; ++k) store(values[k], &passed[k][i]);
  }

  /// Positions 0 .. count - 1 of the tiles, lanes i on. @param out  factors of the first
  void advance(int count, int i, float* out) {
    Block block = passed_to(i), other = passed_to(i + (packs - 1) * width);
    for (int j = 0; j < count; ++j, out += held_factor_entries * Lanes) {
      advance_one(j, i, block, out);
      if constexpr (packs > 1) advance_one(j, i + width, other, out);
    }
    pass(block, i);
    if constexpr (packs > 1) pass(other, i + width);
  }
};

template <int Lanes>
void factor_series(const LineBlock& block, const HeldLineMatrix& matrix, float* factors) {
  Series<Lanes> state;
  for (int position = 0; position < block.length; position += chunk) {
    const int count = block.length - position < chunk ? block.length - position : chunk;
    for (int k = 0; k < 6; ++k)
      read_tile<Lanes>(matrix.held[k], block, position, count, state.held[k]);
    for (int k = 0; k < 4; ++k)
      read_tile<Lanes>(matrix.spring[k], block, position, count, state.spring[k]);
    // Keeps the systems of lanes without a line regular.
    for (int j = 0; j < count; ++j)
      for (int i = block.width; i < Lanes; ++i)
        state.held[0][j][i] = state.held[3][j][i] = state.held[5][j][i] = 1;
    for (int i = 0; i < Lanes; i += Series<Lanes>::packs * width)
      state.advance(count, i, factors + std::ptrdiff_t{position} * held_factor_entries * Lanes);
  }
}

}  // namespace

void factor_lines(const LineBlock& lines, const LineMatrix& matrix, float* factors) {
  if (lines.width > half_lanes)
    factor<line_lanes>(lines, matrix, factors);
  else
    factor<half_lanes>(lines, matrix, factors);
}

void factor_held_lines(const LineBlock& lines, const HeldLineMatrix& matrix, float* factors) {
  if (lines.width > half_lanes)
    factor_series<line_lanes>(lines, matrix, factors);
  else
    factor_series<half_lanes>(lines, matrix, factors);
}

}  // namespace weft::WEFT_KERNEL_SET
