#include "weft/cloth/kernels/isa/packs.h"
#include "weft/cloth/kernels/isa/rows.h"

// Galerkin products of bilinear interpolation, along rows and then across them. Stencils have the
// blocks of a sample in the order centre, right, below, below right, below left.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Some entry of fine columns: the even ones, the odd ones after them and those before them.
struct Fine {
  Pack even, odd, odd_before;
};

/// The last odd column before the next pack, of every plane.
struct Before {
  Pack odd[stencil_blocks];
};

/// One entry of the five blocks at two packs of fine columns.
struct FinePacks {
  Pack a[stencil_blocks], b[stencil_blocks];
};

[[gnu::always_inline]] inline Fine split(const FinePacks& packs, int block, Before& before) {
  const Pack odd = odd_columns(packs.a[block], packs.b[block]);
  const Fine fine{even_columns(packs.a[block], packs.b[block]), odd,
                  to_the_left(before.odd[block], odd)};
  before.odd[block] = odd;
  return fine;
}

/// Coarsens one entry of the five blocks. @param to  [stencil_blocks] where each goes
[[gnu::always_inline]] inline void coarsen_entry(const FinePacks& packs, Before& before, float* to,
                                                 std::ptrdiff_t block) {
  const Pack half = Pack{} + 0.5F, quarter = Pack{} + 0.25F;
  const Fine centre = split(packs, 0, before), right = split(packs, 1, before),
             down = split(packs, 2, before), below_right = split(packs, 3, before),
             below_left = split(packs, 4, before);
  store(centre.even + (right.even + right.odd_before) + quarter * (centre.odd_before + centre.odd),
        to);
  store(half * (right.even + right.odd) + quarter * centre.odd, to + block);
  store(down.even +
            half *
                ((below_right.even + below_left.even) + (below_right.odd_before + below_left.odd)) +
            quarter * (down.odd_before + down.odd),
        to + 2 * block);
  store(half * (below_right.even + below_right.odd) + quarter * down.odd, to + 3 * block);
  store(half * (below_left.even + below_left.odd_before) + quarter * down.odd_before,
        to + 4 * block);
}

/// Nothing is beyond the last coarse column, or before the first.
inline void clear_ends(int m, float* first, std::ptrdiff_t pitch) {
  const std::ptrdiff_t block = block_entries * pitch;
  for (int k = 0; k < block_entries; ++k)
    first[k * pitch + block + m - 1] = first[k * pitch + 3 * block + m - 1] =
        first[k * pitch + 4 * block] = 0;
}
inline void clear_beyond(int m, float* first, std::ptrdiff_t pitch) {
  for (int k = 0; k < block_entries; ++k) first[(4 * block_entries + k) * pitch + m] = 0;
}

/// -(t 1 + s s^T) of the springs of a direction at a pack of columns, times `mask`.
struct SpringBlock {
  Pack entry[block_entries];
  [[gnu::always_inline]] SpringBlock(PlaneRows springs, int direction, int c, Pack mask) {
    const float* first = springs.first + direction * spring_entries * springs.pitch + c;
    const Pack t = load(first), x = load(first + springs.pitch),
               y = load(first + 2 * springs.pitch), z = load(first + 3 * springs.pitch);
    const Pack kx = -mask * x, ky = -mask * y, kz = -mask * z, kt = -mask * t;
    entry[0] = kt + kx * x;
    entry[1] = kx * y;
    entry[2] = kx * z;
    entry[3] = kt + ky * y;
    entry[4] = ky * z;
    entry[5] = kt + kz * z;
  }
};

/// The blocks of springs at a pack of columns.
struct SpringBlocks {
  SpringBlock right, down, below_right, below_left;
  [[gnu::always_inline]] SpringBlocks(PlaneRows springs, int c, const float* mask,
                                      const float* mask_below)
      : right(springs, 0, c, load(mask + c) * load(mask + c + 1)),
        down(springs, 1, c, load(mask + c) * load(mask_below + c)),
        below_right(springs, 2, c, load(mask + c) * load(mask_below + c + 1)),
        below_left(springs, 3, c, load(mask + c) * load(mask_below + c - 1)) {}
};

}  // namespace

void coarsen_columns(int m, PlaneRows fine, MutablePlaneRows half) {
  const std::ptrdiff_t fine_block = block_entries * fine.pitch,
                       half_block = block_entries * half.pitch;
  for (int k = 0; k < block_entries; ++k) {
    const float* from = fine.first + k * fine.pitch;
    Before before{};
    for (int block = 0; block < stencil_blocks; ++block)
      before.odd[block] += from[block * fine_block - 1];
    for (int q = 0; q < m; q += width) {
      FinePacks packs;
      for (int block = 0; block < stencil_blocks; ++block) {
        packs.a[block] = load(from + block * fine_block + 2 * q);
        packs.b[block] = load(from + block * fine_block + 2 * q + width);
      }
      coarsen_entry(packs, before, half.first + k * half.pitch + q, half_block);
    }
  }
  clear_ends(m, half.first, half.pitch);
  clear_beyond(m, half.first, half.pitch);
}

void coarsen_springs(int m, PlaneRows centre, PlaneRows springs, const float* mask,
                     const float* mask_below, MutablePlaneRows half) {
  const std::ptrdiff_t half_block = block_entries * half.pitch;
  Before before[block_entries] = {};
  for (int q = 0; q < m; q += width) {
    const SpringBlocks a(springs, 2 * q, mask, mask_below),
        b(springs, 2 * q + width, mask, mask_below);
    for (int k = 0; k < block_entries; ++k) {
      const float* from = centre.first + k * centre.pitch + 2 * q;
      const FinePacks packs{{load(from), a.right.entry[k], a.down.entry[k], a.below_right.entry[k],
                             a.below_left.entry[k]},
                            {load(from + width), b.right.entry[k], b.down.entry[k],
                             b.below_right.entry[k], b.below_left.entry[k]}};
      coarsen_entry(packs, before[k], half.first + k * half.pitch + q, half_block);
    }
  }
  clear_ends(m, half.first, half.pitch);
  clear_beyond(m, half.first, half.pitch);
}

void coarsen_rows(int m, const PlaneRows* half, MutablePlaneRows coarse) {
  const std::ptrdiff_t block = block_entries * half[0].pitch,
                       coarse_block = block_entries * coarse.pitch;
  const Pack by_half = Pack{} + 0.5F, by_quarter = Pack{} + 0.25F;
  for (int k = 0; k < block_entries; ++k)
    for (int q = 0; q < m; q += width) {
      const auto at = [&](int row, int which, int shift = 0) {
        return load(half[row].first + which * block + k * half[row].pitch + q + shift);
      };
      Pack sums[stencil_blocks];
      sums[0] = at(1, 0) + (at(1, 2) + at(0, 2)) + by_quarter * (at(2, 0) + at(0, 0));
      sums[1] = at(1, 1) + by_half * ((at(1, 3) + at(1, 4, 1)) + (at(0, 3) + at(0, 4, 1))) +
                by_quarter * (at(2, 1) + at(0, 1));
      sums[2] = by_half * (at(1, 2) + at(2, 2)) + by_quarter * at(2, 0);
      sums[3] = by_half * (at(1, 3) + at(2, 3)) + by_quarter * at(2, 1);
      sums[4] = by_half * (at(1, 4) + at(2, 4)) + by_quarter * at(2, 1, -1);
      float* to = coarse.first + k * coarse.pitch + q;
      for (int which = 0; which < stencil_blocks; ++which)
        store_first(m - q, sums[which], to + which * coarse_block);
    }
  clear_ends(m, coarse.first, coarse.pitch);
}

}  // namespace weft::WEFT_KERNEL_SET
