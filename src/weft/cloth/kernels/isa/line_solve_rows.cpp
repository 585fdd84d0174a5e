#include "weft/cloth/kernels/isa/line_tiles.h"
#include "weft/cloth/kernels/isa/rows.h"

// Block tridiagonal systems of neighbouring lines, solved side by side in lanes with their factors.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// out = G v for the blocks of a position
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

/// The product of a coupling block and a vector: B v for blocks, -(t v + s (s . v)) for springs.
struct BlockPull {
  static constexpr int entries = line_factor_entries;
  template <int lanes>
  static void apply(const float* blocks, const float (*v)[lanes], float (*out)[lanes]) {
    multiply<lanes>(blocks, v, out);
  }
};
struct SpringPull {
  static constexpr int entries = held_factor_entries;
  template <int lanes>
  static void apply(const float* spring, const float (*v)[lanes], float (*out)[lanes]) {
#pragma omp simd
    for (int i = 0; i < lanes; ++i) {
      const float t = spring[i], x = spring[lanes + i], y = spring[2 * lanes + i],
                  z = spring[3 * lanes + i];
      const float along = x * v[0][i] + y * v[1][i] + z * v[2][i];
      out[0][i] = -(t * v[0][i] + along * x);
      out[1][i] = -(t * v[1][i] + along * y);
      out[2][i] = -(t * v[2][i] + along * z);
    }
  }
};

template <int lanes, class Pull>
void solve(const LineBlock& block, const float* factors, const PlaneView* rhs, float scale,
           bool add, float* scratch, const MutablePlaneView* out) {
  using Vectors = float(*)[lanes];
  constexpr std::ptrdiff_t entries = std::ptrdiff_t{Pull::entries} * lanes;
  alignas(64) float tile[3][chunk][lanes];
  if (block.width < lanes) __builtin_memset(tile, 0, sizeof tile);
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
      Pull::template apply<lanes>(blocks + 6 * lanes, here, passed);
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
      Pull::template apply<lanes>(blocks + 6 * lanes, later, passed);
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

}  // namespace

void solve_lines(const LineBlock& lines, const float* factors, const PlaneView* rhs, float scale,
                 bool add, float* scratch, const MutablePlaneView* out) {
  if (lines.width > half_lanes)
    solve<line_lanes, BlockPull>(lines, factors, rhs, scale, add, scratch, out);
  else
    solve<half_lanes, BlockPull>(lines, factors, rhs, scale, add, scratch, out);
}

void solve_held_lines(const LineBlock& lines, const float* factors, const PlaneView* rhs,
                      float scale, bool add, float* scratch, const MutablePlaneView* out) {
  if (lines.width > half_lanes)
    solve<line_lanes, SpringPull>(lines, factors, rhs, scale, add, scratch, out);
  else
    solve<half_lanes, SpringPull>(lines, factors, rhs, scale, add, scratch, out);
}

}  // namespace weft::WEFT_KERNEL_SET
