#include "weft/cloth/kernels/isa/rows.h"

// A patch is applied in two passes: a weighted sum down its columns for every distance from the
// middle one, then a sum of these along the row. Rows are read once for several distances, and only
// the second pass is unaligned.

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Rows of a Grid are padded to a multiple of this.
constexpr int width = 16;
/// Distances that are summed together, as many as there are registers for.
constexpr int max_distances = 6;

inline int padded(int n) { return (n + width - 1) / width * width; }

/// lines[first + l] = the weighted sum of the rows for distance first + l, l < Count.
template <int Count>
inline void weigh_columns(int n, const float* const* rows, const PatchWeights& patch, int first,
                          float* lines, std::ptrdiff_t stride) {
  for (int c = 0; c < n; c += width) {
    float sums[Count][width] = {};
    const float* w = patch.centred + first;
    for (int k = 0; k < patch.rows; ++k, w += patch.half + 1) {
      const float* row = rows[k] + c;
      for (int l = 0; l < Count; ++l) {
#pragma omp simd
        for (int i = 0; i < width; ++i) sums[l][i] += w[l] * row[i];
      }
    }
    for (int l = 0; l < Count; ++l) {
      float* line = lines + (first + l) * stride + c;
#pragma omp simd
      for (int i = 0; i < width; ++i) line[i] = sums[l][i];
    }
  }
}

inline void weigh_distances(int n, const float* const* rows, const PatchWeights& patch,
                            float* lines, std::ptrdiff_t stride) {
  int first = 0;
  for (; patch.half + 1 - first >= max_distances; first += max_distances)
    weigh_columns<max_distances>(n, rows, patch, first, lines, stride);
  switch (patch.half + 1 - first) {
    case 5:
      return weigh_columns<5>(n, rows, patch, first, lines, stride);
    case 4:
      return weigh_columns<4>(n, rows, patch, first, lines, stride);
    case 3:
      return weigh_columns<3>(n, rows, patch, first, lines, stride);
    case 2:
      return weigh_columns<2>(n, rows, patch, first, lines, stride);
    case 1:
      return weigh_columns<1>(n, rows, patch, first, lines, stride);
    default:
      return;
  }
}

template <int Columns>
inline __attribute__((always_inline)) void add_block(int half, const float* lines,
                                                     std::ptrdiff_t stride, int c, float* out) {
  float sum[Columns];
#pragma omp simd
  for (int i = 0; i < Columns; ++i) sum[i] = lines[c + i];
  for (int l = 1; l <= half; ++l) {
    const float* line = lines + l * stride + c;
#pragma omp simd
    for (int i = 0; i < Columns; ++i) sum[i] += line[i - l] + line[i + l];
  }
#pragma omp simd
  for (int i = 0; i < Columns; ++i) out[c + i] = sum[i];
}

/// Sums along a row in blocks of columns. The last block overlaps the one before and repeats its
/// sums.
template <int Columns>
inline void add_blocks(int n, int half, const float* lines, std::ptrdiff_t stride, float* out) {
  const int last = n - half;
  for (int c = half; c < last; c += Columns)
    add_block<Columns>(half, lines, stride, c + Columns <= last ? c : last - Columns, out);
}

inline void add_along(int n, int half, const float* lines, std::ptrdiff_t stride, float* out) {
  if (n - 2 * half >= width)
    add_blocks<width>(n, half, lines, stride, out);
  else if (n - 2 * half >= 4)
    add_blocks<4>(n, half, lines, stride, out);
  else
    add_blocks<1>(n, half, lines, stride, out);
}

/// Columns `column` .. of the left side and their mirror images of the right.
template <int Columns>
inline __attribute__((always_inline)) void beside(int n, const float* const* rows,
                                                  const PatchWeights& patch, int column,
                                                  float* out) {
  // Two sums each, which do not wait for each other's additions.
  float left[2][Columns] = {}, right[2][Columns] = {};
  const int side = 2 * patch.half + 1;
  const float* w = patch.beside + column;
  for (int k = 0; k < patch.rows; ++k) {
    const float *from_left = rows[k], *from_right = rows[k] + n - 1;
    const auto add = [&](int which, int l) __attribute__((always_inline)) {
      const float* weights = w + l * patch.lanes;
      const float a = from_left[l], b = from_right[-l];
#pragma omp simd
      for (int i = 0; i < Columns; ++i) left[which][i] += weights[i] * a;
#pragma omp simd
      for (int i = 0; i < Columns; ++i) right[which][i] += weights[i] * b;
    };
    for (int l = 0; l + 1 < side; l += 2) {
      add(0, l);
      add(1, l + 1);
    }
    add(0, side - 1);
    w += side * patch.lanes;
  }
  for (int i = 0; i < Columns && column + i < patch.half; ++i) {
    out[column + i] = left[0][i] + left[1][i];
    out[n - 1 - column - i] = right[0][i] + right[1][i];
  }
}

}  // namespace

void add_rows(int n, const float* a, const float* b, float* out) {
  const int all = padded(n);
#pragma omp simd
  for (int c = 0; c < all; ++c) out[c] = a[c] + b[c];
}

void patch_row(int n, const float* const* rows, const PatchWeights& patch, float* lines,
               float* out) {
  const std::ptrdiff_t stride = padded(n);
  weigh_distances(n, rows, patch, lines, stride);
  add_along(n, patch.half, lines, stride, out);
  int column = 0;
  for (; patch.half - column > 4; column += 8) beside<8>(n, rows, patch, column, out);
  if (column < patch.half) beside<4>(n, rows, patch, column, out);
}

}  // namespace weft::WEFT_KERNEL_SET
