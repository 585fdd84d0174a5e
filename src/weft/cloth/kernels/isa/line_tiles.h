#pragma once

#include "weft/cloth/kernels/isa/packs.h"
#include "weft/cloth/kernels/newton_kernels.h"

// Tiles of planes in which the lines of a block lie side by side in lanes.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Positions that are read at a time.
constexpr int chunk = 16;
constexpr int half_lanes = line_lanes / 2;

/// Lines that are transposed at a time.
constexpr int side = 8;
using Eight = float __attribute__((vector_size(4 * side)));
using LooseEight = float __attribute__((vector_size(4 * side), aligned(4), may_alias));

/// An 8 x 8 matrix, by rows, becomes its transpose.
[[gnu::always_inline]] inline void transpose(Eight* m) {
  Eight a[side], b[side];
  for (int i = 0; i < side; i += 2) {
    a[i] = __builtin_shufflevector(m[i], m[i + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    a[i + 1] = __builtin_shufflevector(m[i], m[i + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (int i = 0; i < side; i += 4) {
    b[i] = __builtin_shufflevector(a[i], a[i + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    b[i + 1] = __builtin_shufflevector(a[i], a[i + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    b[i + 2] = __builtin_shufflevector(a[i + 1], a[i + 3], 0, 1, 8, 9, 4, 5, 12, 13);
    b[i + 3] = __builtin_shufflevector(a[i + 1], a[i + 3], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (int i = 0; i < side / 2; ++i) {
    m[i] = __builtin_shufflevector(b[i], b[i + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    m[i + 4] = __builtin_shufflevector(b[i], b[i + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// Element j of line i becomes tile[j][i]. Lanes beyond the last line get finite values.
template <int Lanes>
inline void read_tile(const PlaneView& plane, const LineBlock& block, int position, int count,
                      float (*tile)[Lanes]) {
  const int lines = block.width;
  if (block.along_rows) {
    for (int i = 0; i < lines; i += side) {
      const float* line[side];
      for (int k = 0; k < side; ++k)
        line[k] =
            plane.base + (block.first + (i + k < lines ? i + k : i)) * plane.stride + position;
      for (int j = 0; j < chunk; j += side) {
        Eight m[side];
        for (int k = 0; k < side; ++k) m[k] = *reinterpret_cast<const LooseEight*>(line[k] + j);
        transpose(m);
        for (int k = 0; k < side; ++k) *reinterpret_cast<LooseEight*>(&tile[j + k][i]) = m[k];
      }
    }
    return;
  }
  for (int j = 0; j < count; ++j) {
    const float* line = plane.base + (position + j) * plane.stride + block.first;
    // Beyond the last line is the frame.
    for (int i = 0; i < Lanes; i += width) store(load(line + i), tile[j] + i);
  }
}

/// Eight lines from a position on. @param lines, positions  how many of both there are
inline void write_eight(const Eight* m, const MutablePlaneView& plane, float* first, int lines,
                        int positions, bool add) {
  for (int k = 0; k < lines; ++k) {
    float* const line = first + k * plane.stride;
    if (positions >= side) {
      auto* const eight = reinterpret_cast<LooseEight*>(line);
      *eight = add ? *eight + m[k] : m[k];
    } else {
      for (int p = 0; p < positions; ++p) line[p] = add ? line[p] + m[k][p] : m[k][p];
    }
  }
}

template <int Lanes>
inline void write_tile(const MutablePlaneView& plane, const LineBlock& block, int position,
                       int count, const float (*tile)[Lanes], bool add) {
  const int lines = block.width;
  if (block.along_rows) {
    for (int i = 0; i < lines; i += side)
      for (int j = 0; j < count; j += side) {
        Eight m[side];
        for (int k = 0; k < side; ++k) m[k] = *reinterpret_cast<const LooseEight*>(&tile[j + k][i]);
        transpose(m);
        write_eight(m, plane, plane.base + (block.first + i) * plane.stride + position + j,
                    lines - i < side ? lines - i : side, count - j, add);
      }
    return;
  }
  for (int j = 0; j < count; ++j) {
    float* line = plane.base + (position + j) * plane.stride + block.first;
    const int whole = lines / width * width;
    for (int i = 0; i < whole; i += width)
      store(add ? load(line + i) + load(tile[j] + i) : load(tile[j] + i), line + i);
    for (int i = whole; i < lines; ++i) line[i] = add ? line[i] + tile[j][i] : tile[j][i];
  }
}

}  // namespace
}  // namespace weft::WEFT_KERNEL_SET
