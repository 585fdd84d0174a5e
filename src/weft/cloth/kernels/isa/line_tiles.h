#pragma once

#include "weft/cloth/kernels/newton_kernels.h"
#include "weft/core/four.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Positions that are read at a time.
constexpr int chunk = 16;
constexpr int half_lanes = line_lanes / 2;

using UnalignedFour = float __attribute__((vector_size(16), aligned(4), may_alias));

/// Element j of line i becomes tile[j][i]. Lanes beyond the last line get finite values.
template <int lanes>
inline void read_tile(const PlaneView& plane, const LineBlock& block, int position, int count,
                      float (*tile)[lanes]) {
  const int width = block.width;
  if (block.along_rows) {
    for (int i = 0; i < width; i += 4) {
      const float* line[4];
      for (int k = 0; k < 4; ++k)
        line[k] =
            plane.base + (block.first + (i + k < width ? i + k : i)) * plane.stride + position;
      for (int j = 0; j < chunk; j += 4) {
        Four m[4];
        for (int k = 0; k < 4; ++k) m[k] = *reinterpret_cast<const UnalignedFour*>(line[k] + j);
        transpose(m);
        for (int k = 0; k < 4; ++k) *reinterpret_cast<UnalignedFour*>(&tile[j + k][i]) = m[k];
      }
    }
    return;
  }
  for (int j = 0; j < count; ++j) {
    const float* line = plane.base + (position + j) * plane.stride + block.first;
    // Beyond the last line is the frame.
#pragma omp simd
    for (int i = 0; i < lanes; ++i) tile[j][i] = line[i];
  }
}

template <int lanes>
inline void write_tile(const MutablePlaneView& plane, const LineBlock& block, int position,
                       int count, const float (*tile)[lanes], bool add) {
  const int width = block.width;
  if (block.along_rows) {
    for (int i = 0; i < width; i += 4)
      for (int j = 0; j < count; j += 4) {
        Four m[4];
        for (int k = 0; k < 4; ++k) m[k] = *reinterpret_cast<const UnalignedFour*>(&tile[j + k][i]);
        transpose(m);
        float* const first = plane.base + (block.first + i) * plane.stride + position + j;
        const int lines = width - i < 4 ? width - i : 4;
        for (int k = 0; k < lines; ++k) {
          float* const line = first + k * plane.stride;
          if (j + 4 <= count) {
            auto* const four = reinterpret_cast<UnalignedFour*>(line);
            *four = add ? *four + m[k] : m[k];
          } else {
            for (int p = 0; p < count - j; ++p) line[p] = add ? line[p] + m[k][p] : m[k][p];
          }
        }
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

}  // namespace
}  // namespace weft::WEFT_KERNEL_SET
