#include "weft/cloth/kernels/isa/packs.h"
#include "weft/cloth/kernels/isa/rows.h"

// Bilinear interpolation between a level and the next coarser one, and its transpose.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Fine columns c on, weighed across rows.
[[gnu::always_inline]] inline Pack3 across(const RowTriple& fine, int c, Pack half) {
  return load(fine.here, c) + half * (load(fine.above, c) + load(fine.below, c));
}

/// Coarse columns from two packs of fine ones. @param before  the odd columns before these
[[gnu::always_inline]] inline Pack along(Pack a, Pack b, Pack half, Pack& before) {
  const Pack odd = odd_columns(a, b);
  const Pack sum = even_columns(a, b) + half * (to_the_left(before, odd) + odd);
  before = odd;
  return sum;
}

[[gnu::always_inline]] inline void add(int count, Pack value, float* to) {
  store_first(count, load(to) + value, to);
}

}  // namespace

void restrict_row(int m, const RowTriple& fine, Row3 coarse) {
  const Pack half = Pack{} + 0.5F;
  const auto last = [&](const float* above, const float* here, const float* below) {
    return Pack{} + (here[-1] + 0.5F * (above[-1] + below[-1]));
  };
  Pack3 before{last(fine.above.x, fine.here.x, fine.below.x),
               last(fine.above.y, fine.here.y, fine.below.y),
               last(fine.above.z, fine.here.z, fine.below.z)};
  for (int q = 0; q < m; q += width) {
    const Pack3 a = across(fine, 2 * q, half), b = across(fine, 2 * q + width, half);
    const Pack x = along(a.x, b.x, half, before.x), y = along(a.y, b.y, half, before.y),
               z = along(a.z, b.z, half, before.z);
    store_first(m - q, {x, y, z}, coarse, q);
  }
}

void prolong_row(int n, ConstRow3 first, ConstRow3 second, Row3 fine) {
  const Pack half = Pack{} + 0.5F;
  const float* const a[3] = {first.x, first.y, first.z};
  const float* const b[3] = {second.x, second.y, second.z};
  float* const out[3] = {fine.x, fine.y, fine.z};
  for (int k = 0; k < 3; ++k) {
    Pack here = half * (load(a[k]) + load(b[k]));
    for (int c = 0; c < n; c += 2 * width) {
      const int q = c / 2 + width;
      const Pack after = half * (load(a[k] + q) + load(b[k] + q));
      const PackPair both = interleaved(here, half * (here + to_the_right(here, after)));
      add(n - c, both.first, out[k] + c);
      if (n - c > width) add(n - c - width, both.second, out[k] + c + width);
      here = after;
    }
  }
}

}  // namespace weft::WEFT_KERNEL_SET
