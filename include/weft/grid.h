#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

#include "weft/vec.h"

namespace weft {

/// A non-owning view of a rows x cols plane; row r starts at data + r * stride.
template <class T>
struct GridView {
  T* data = nullptr;
  int rows = 0, cols = 0;
  std::ptrdiff_t stride = 0;

  [[nodiscard]] T* row(int r) const { return data + r * stride; }
  [[nodiscard]] T& operator()(int r, int c) const { return data[r * stride + c]; }
  /// A view may always be narrowed to a read-only one.
  operator GridView<const T>() const  // NOLINT(google-explicit-constructor)
      requires(!std::is_const_v<T>) {
    return {data, rows, cols, stride};
  }
};

/// A rows x cols plane of plain values. Rows are padded to whole cache lines (64 bytes) and aligned
/// to them, so that row kernels vectorise; the padding starts as zeros and has no meaning.
template <class T>
class Grid {
  static_assert(std::is_trivially_copyable_v<T>);
  static constexpr std::size_t alignment = 64;

 public:
  Grid() = default;
  Grid(int rows, int cols, T value = T{})
      : rows_(rows), cols_(cols), stride_(padded(cols)), data_(allocate(rows * stride_)) {
    for (std::ptrdiff_t i = 0; i < rows * stride_; ++i) data_[i] = T{};
    fill(value);
  }
  Grid(const Grid& other) : Grid(other.rows_, other.cols_) { copy_from(other); }
  Grid& operator=(const Grid& other) {
    if (this == &other) return *this;
    if (rows_ != other.rows_ || cols_ != other.cols_) *this = Grid(other.rows_, other.cols_);
    copy_from(other);
    return *this;
  }
  Grid(Grid&&) noexcept = default;
  Grid& operator=(Grid&&) noexcept = default;
  ~Grid() = default;

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int cols() const { return cols_; }
  [[nodiscard]] std::ptrdiff_t stride() const { return stride_; }
  [[nodiscard]] T* row(int r) { return data_.get() + r * stride_; }
  [[nodiscard]] const T* row(int r) const { return data_.get() + r * stride_; }
  [[nodiscard]] T& operator()(int r, int c) {
    assert(r >= 0 && r < rows_ && c >= 0 && c < cols_);
    return row(r)[c];
  }
  [[nodiscard]] const T& operator()(int r, int c) const {
    assert(r >= 0 && r < rows_ && c >= 0 && c < cols_);
    return row(r)[c];
  }
  [[nodiscard]] GridView<T> view() { return {data_.get(), rows_, cols_, stride_}; }
  [[nodiscard]] GridView<const T> view() const { return {data_.get(), rows_, cols_, stride_}; }

  /// Sets every element; the padding is left alone.
  void fill(T value) {
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < cols_; ++c) row(r)[c] = value;
  }

 private:
  struct Free {
    void operator()(T* p) const { ::operator delete (p, std::align_val_t{alignment}); }
  };
  static std::ptrdiff_t padded(int cols) {
    constexpr auto line =
        static_cast<std::ptrdiff_t>(alignment / sizeof(T) > 0 ? alignment / sizeof(T) : 1);
    return (cols + line - 1) / line * line;
  }
  static T* allocate(std::ptrdiff_t count) {
    return static_cast<T*>(
        ::operator new (static_cast<std::size_t>(count) * sizeof(T), std::align_val_t{alignment}));
  }
  void copy_from(const Grid& other) {
    for (std::ptrdiff_t i = 0; i < rows_ * stride_; ++i) data_[i] = other.data_[i];
  }

  int rows_ = 0, cols_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::unique_ptr<T[], Free> data_;
};

/// A vector for each sample of an n x n grid, one plane per coordinate (structure of arrays).
struct Planes3 {
  Grid<float> x, y, z;

  Planes3() = default;
  explicit Planes3(int n) : x(n, n), y(n, n), z(n, n) {}
  [[nodiscard]] int size() const { return x.rows(); }
  [[nodiscard]] Vec3f at(int row, int col) const { return {x(row, col), y(row, col), z(row, col)}; }
  void set(int row, int col, Vec3f p) {
    x(row, col) = p.x;
    y(row, col) = p.y;
    z(row, col) = p.z;
  }
  /// By sample index row * n + col.
  [[nodiscard]] Vec3f at(int sample) const { return at(sample / size(), sample % size()); }
  void set(int sample, Vec3f p) { set(sample / size(), sample % size(), p); }
};

/// The largest displacement of a sample between two grids of the same size. [m]
double largest_displacement(const Planes3& from, const Planes3& to) noexcept;

}  // namespace weft
