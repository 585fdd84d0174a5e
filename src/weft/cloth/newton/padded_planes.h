#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <new>

#include "weft/cloth/kernels/newton_kernels.h"
#include "weft/cloth/kernels/row_pointers.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The number of columns rounded up to whole vectors, so that loops have no remainder; zeros in the
/// frame stay 0.
inline int whole_vectors(int cols) { return (cols + 15) / 16 * 16; }

/// Frees what begins on a cache line.
struct FreeAligned {
  static constexpr std::align_val_t alignment{64};
  void operator()(float* p) const { ::operator delete(p, alignment); }
};
using AlignedFloats = std::unique_ptr<float[], FreeAligned>;
/// So many zeros from a cache line on.
inline AlignedFloats aligned_zeros(std::size_t count) {
  AlignedFloats made(
      static_cast<float*>(::operator new(count * sizeof(float), FreeAligned::alignment)));
  std::fill_n(made.get(), count, 0.0F);
  return made;
}

/// rows x cols floats inside a frame of zeros, so that stencils need no borders: two rows above and
/// below, and at least 16 columns on either side. Rows begin on cache lines, and neighbouring rows
/// never fall on the same cache sets. Beyond the elements inside only zeros may be written.
class PaddedPlane {
 public:
  PaddedPlane() = default;
  PaddedPlane(int rows, int cols) : rows_(rows), cols_(cols), stride_(stride_for(cols)) {
    const std::size_t count =
        static_cast<std::size_t>(stride_) * (rows + 2 * frame_rows) + read_beyond;
    data_ = aligned_zeros(count);
  }

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int cols() const { return cols_; }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  /// Of all planes of so many columns.
  static std::ptrdiff_t stride_for(int cols) {
    const std::ptrdiff_t wide = (cols + 2 * frame_cols + 15) / 16 * 16;
    return wide % 256 == 0 ? wide + 16 : wide;
  }
  /// @param r  from -2 to rows + 1
  [[nodiscard]] float* row(int r) { return data_.get() + offset(r); }
  [[nodiscard]] const float* row(int r) const { return data_.get() + offset(r); }
  [[nodiscard]] float& operator()(int r, int c) { return row(r)[c]; }
  [[nodiscard]] float operator()(int r, int c) const { return row(r)[c]; }

 private:
  static constexpr int frame_rows = 2, frame_cols = 16;
  /// Rows that become every second column are read in whole vectors of those.
  static constexpr std::size_t read_beyond = 32;
  [[nodiscard]] std::ptrdiff_t offset(int r) const {
    return (r + frame_rows) * stride_ + frame_cols;
  }

  int rows_ = 0, cols_ = 0;
  std::ptrdiff_t stride_ = 0;
  AlignedFloats data_;
};

/// A vector field, one vector a sample.
struct PaddedVectors {
  PaddedPlane x, y, z;

  PaddedVectors() = default;
  PaddedVectors(int rows, int cols) : x(rows, cols), y(rows, cols), z(rows, cols) {}
  [[nodiscard]] int rows() const { return x.rows(); }
  [[nodiscard]] Row3 row(int r) { return {x.row(r), y.row(r), z.row(r)}; }
  [[nodiscard]] ConstRow3 row(int r) const { return {x.row(r), y.row(r), z.row(r)}; }
};

inline void copy_row(ConstRow3 from, Row3 to, int n) {
  std::copy_n(from.x, n, to.x);
  std::copy_n(from.y, n, to.y);
  std::copy_n(from.z, n, to.z);
}

inline void clear_row(Row3 row, int n) {
  std::fill_n(row.x, n, 0.0F);
  std::fill_n(row.y, n, 0.0F);
  std::fill_n(row.z, n, 0.0F);
}

/// Several planes in frames of zeros whose rows alternate: row 0 of each, row 1 of each, and so on.
/// A kernel reads a row of all with one pointer and their distance. The frame has a row above and
/// below, and 16 columns on either side.
class PlaneSet {
 public:
  PlaneSet() = default;
  PlaneSet(int rows, int cols, int count)
      : rows_(rows), cols_(cols), count_(count), pitch_((cols + 2 * frame_cols + 15) / 16 * 16) {
    data_ = aligned_zeros(static_cast<std::size_t>(rows + 2) * stride());
  }

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int cols() const { return cols_; }
  [[nodiscard]] int count() const { return count_; }
  /// Floats from a row of a plane to that of the next plane, and to the next row of the same.
  [[nodiscard]] std::ptrdiff_t pitch() const { return pitch_; }
  [[nodiscard]] std::ptrdiff_t stride() const { return pitch_ * count_; }
  /// @param r  from -1 to rows
  [[nodiscard]] float* row(int r, int plane = 0) { return data_.get() + offset(r, plane); }
  [[nodiscard]] const float* row(int r, int plane = 0) const {
    return data_.get() + offset(r, plane);
  }
  [[nodiscard]] float& operator()(int r, int c, int plane) { return row(r, plane)[c]; }
  [[nodiscard]] float operator()(int r, int c, int plane) const { return row(r, plane)[c]; }
  [[nodiscard]] PlaneView view(int plane) const { return {row(0, plane), stride()}; }
  /// A row of all planes becomes 0.
  void clear_row(int r) { std::fill_n(data_.get() + (r + 1) * stride(), stride(), 0.0F); }

 private:
  static constexpr int frame_cols = 16;
  [[nodiscard]] std::ptrdiff_t offset(int r, int plane) const {
    return (r + 1) * stride() + plane * pitch_ + frame_cols;
  }

  int rows_ = 0, cols_ = 0, count_ = 0;
  std::ptrdiff_t pitch_ = 0;
  AlignedFloats data_;
};

/// Three rows of a field from a column on. @param r  from -1 to rows
inline RowTriple rows_around(const PaddedVectors& field, int r, int first_col = 0) {
  const auto from = [&](int row) {
    const ConstRow3 at = field.row(row);
    return ConstRow3{at.x + first_col, at.y + first_col, at.z + first_col};
  };
  return {from(r - 1), from(r), from(r + 1)};
}

/// A row of a set from a column on, which may be -1.
inline PlaneRows rows_of(const PlaneSet& planes, int r, int first_col = 0) {
  return {planes.row(r) + first_col, planes.pitch()};
}
inline MutablePlaneRows rows_of(PlaneSet& planes, int r, int first_col = 0) {
  return {planes.row(r) + first_col, planes.pitch()};
}

/// The workers of a level: all of a team, or one for whom the others wait.
class Workers {
 public:
  Workers(Worker& worker, bool alone)  // alone: only the worker of rank 0 may call
      : worker_(&worker), alone_(alone) {}
  [[nodiscard]] Range share(int count) const {
    return alone_ ? Range{0, count} : worker_->share(count);
  }
  void barrier() const {
    if (!alone_) worker_->barrier();
  }
  [[nodiscard]] int rank() const { return worker_->rank(); }
  [[nodiscard]] bool alone() const { return alone_ || worker_->alone(); }
  [[nodiscard]] Worker& worker() const { return *worker_; }

 private:
  Worker* worker_;
  bool alone_;
};

}  // namespace weft
