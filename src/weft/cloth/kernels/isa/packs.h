#pragma once

#include "weft/cloth/kernels/row_pointers.h"

// Vectors as wide as the instruction set's registers, for kernels in which values shall stay in
// registers from column to column.
namespace weft::WEFT_KERNEL_SET {
namespace {

#if defined __AVX512F__
constexpr int width = 16;
#elif defined __AVX2__
constexpr int width = 8;
#else
constexpr int width = 4;
#endif

/// Neighbouring columns of a row.
using Pack = float __attribute__((vector_size(4 * width)));
using LoosePack = float __attribute__((vector_size(4 * width), aligned(4), may_alias));

[[gnu::always_inline]] inline Pack load(const float* from) {
  return *reinterpret_cast<const LoosePack*>(from);
}
[[gnu::always_inline]] inline void store(Pack value, float* to) {
  *reinterpret_cast<LoosePack*>(to) = value;
}
[[gnu::always_inline]] inline Pack larger(Pack a, Pack b) { return a > b ? a : b; }

/// The columns one to the right, of a pack and the one after it.
[[gnu::always_inline]] inline Pack to_the_right(Pack here, Pack after) {
#if defined __AVX512F__
  return __builtin_shufflevector(here, after, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,
                                 16);
#elif defined __AVX2__
  return __builtin_shufflevector(here, after, 1, 2, 3, 4, 5, 6, 7, 8);
#else
  return __builtin_shufflevector(here, after, 1, 2, 3, 4);
#endif
}

/// The columns one to the left, of the pack before and a pack.
[[gnu::always_inline]] inline Pack to_the_left(Pack before, Pack here) {
#if defined __AVX512F__
  return __builtin_shufflevector(before, here, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27,
                                 28, 29, 30);
#elif defined __AVX2__
  return __builtin_shufflevector(before, here, 7, 8, 9, 10, 11, 12, 13, 14);
#else
  return __builtin_shufflevector(before, here, 3, 4, 5, 6);
#endif
}

/// Every second column of two packs.
[[gnu::always_inline]] inline Pack even_columns(Pack a, Pack b) {
#if defined __AVX512F__
  return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
#elif defined __AVX2__
  return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
#else
  return __builtin_shufflevector(a, b, 0, 2, 4, 6);
#endif
}
[[gnu::always_inline]] inline Pack odd_columns(Pack a, Pack b) {
#if defined __AVX512F__
  return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
#elif defined __AVX2__
  return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
#else
  return __builtin_shufflevector(a, b, 1, 3, 5, 7);
#endif
}

/// The columns of two packs in turn, a's first.
struct PackPair {
  Pack first, second;
};
[[gnu::always_inline]] inline PackPair interleaved(Pack a, Pack b) {
#if defined __AVX512F__
  return {
      __builtin_shufflevector(a, b, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23),
      __builtin_shufflevector(a, b, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31)};
#elif defined __AVX2__
  return {__builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11),
          __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15)};
#else
  return {__builtin_shufflevector(a, b, 0, 4, 1, 5), __builtin_shufflevector(a, b, 2, 6, 3, 7)};
#endif
}

/// The first `count` columns of a, the rest of b.
[[gnu::always_inline]] inline Pack first_columns(int count, Pack a, Pack b) {
  Pack column;
  for (int i = 0; i < width; ++i) column[i] = static_cast<float>(i);
  return column < static_cast<float>(count) ? a : b;
}
/// Stores no more than the first `count` columns.
[[gnu::always_inline]] inline void store_first(int count, Pack value, float* to) {
  store(count < width ? first_columns(count, value, load(to)) : value, to);
}

/// A vector of three coordinates at each of neighbouring columns.
struct Pack3 {
  Pack x, y, z;
};
[[gnu::always_inline]] inline Pack3 load(ConstRow3 from, int c) {
  return {load(from.x + c), load(from.y + c), load(from.z + c)};
}
[[gnu::always_inline]] inline void store(Pack3 value, Row3 to, int c) {
  store(value.x, to.x + c);
  store(value.y, to.y + c);
  store(value.z, to.z + c);
}
[[gnu::always_inline]] inline void store_first(int count, Pack3 value, Row3 to, int c) {
  store_first(count, value.x, to.x + c);
  store_first(count, value.y, to.y + c);
  store_first(count, value.z, to.z + c);
}
[[gnu::always_inline]] inline ConstRow3 constant(Row3 row) { return {row.x, row.y, row.z}; }
[[gnu::always_inline]] inline Pack3 operator+(Pack3 a, Pack3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[gnu::always_inline]] inline Pack3 operator-(Pack3 a, Pack3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] inline Pack3 operator*(Pack a, Pack3 b) {
  return {a * b.x, a * b.y, a * b.z};
}
[[gnu::always_inline]] inline Pack dot(Pack3 a, Pack3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] inline Pack3 to_the_right(Pack3 here, Pack3 after) {
  return {to_the_right(here.x, after.x), to_the_right(here.y, after.y),
          to_the_right(here.z, after.z)};
}
[[gnu::always_inline]] inline Pack3 to_the_left(Pack3 before, Pack3 here) {
  return {to_the_left(before.x, here.x), to_the_left(before.y, here.y),
          to_the_left(before.z, here.z)};
}

}  // namespace
}  // namespace weft::WEFT_KERNEL_SET
