#include "weft/cloth/kernels/isa/packs.h"
#include "weft/cloth/kernels/isa/rows.h"

// Products with the Hessian of near springs and with stencils of 3 x 3 blocks. Each entry is read
// once: what it gives to the row below is passed on with the sweep, so rows are computed in
// ascending order.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Of a block's or spring's planes.
struct Planes {
  const float* first;
  std::ptrdiff_t pitch;
  [[gnu::always_inline]] Pack at(int k, int c) const { return load(first + k * pitch + c); }
};

/// B x
[[gnu::always_inline]] inline Pack3 block_times(const Planes& block, int c, const Pack3& v) {
  const Pack xy = block.at(1, c), xz = block.at(2, c), yz = block.at(4, c);
  return {block.at(0, c) * v.x + xy * v.y + xz * v.z, xy * v.x + block.at(3, c) * v.y + yz * v.z,
          xz * v.x + yz * v.y + block.at(5, c) * v.z};
}

/// (t 1 + s s^T) times a difference, taken first, so that nothing cancels.
[[gnu::always_inline]] inline Pack3 resist(const Planes& spring, int c, const Pack3& apart) {
  const Pack3 s{spring.at(1, c), spring.at(2, c), spring.at(3, c)};
  return spring.at(0, c) * apart + dot(s, apart) * s;
}

template <bool Subtracted>
[[gnu::always_inline]] inline void put(const Pack3& product, ConstRow3 rhs, Row3 out, int c) {
  store(Subtracted ? load(rhs, c) - product : product, out, c);
}

template <bool Subtracted>
void springs_times(int n, PlaneRows springs, const float* mass, const ProductRow& row, Row3 out) {
  const std::ptrdiff_t direction = spring_entries * springs.pitch;
  const Planes to_right{springs.first, springs.pitch},
      down{springs.first + direction, springs.pitch},
      to_below_right{springs.first + 2 * direction, springs.pitch},
      to_below_left{springs.first + 3 * direction, springs.pitch};
  const Pack3 none{};
  Pack3 here = load(row.here, 0), below = load(row.below, 0), below_before = none;
  Pack3 right_before = none, diagonal_before = none, left_before = none, pending = none;
  for (int c = 0; c < n; c += width) {
    const Pack3 after = load(row.here, c + width), below_after = load(row.below, c + width);
    const Pack3 right = resist(to_right, c, here - to_the_right(here, after)),
                straight = resist(down, c, here - below),
                diagonal = resist(to_below_right, c, here - to_the_right(below, below_after)),
                left = resist(to_below_left, c, here - to_the_left(below_before, below));
    const Pack3 inner = load(mass + c) * here + load(row.passing.carried, c);
    put<Subtracted>(
        inner + (right + straight) + (diagonal + left) - to_the_left(right_before, right), row.rhs,
        out, c);
    if (c > 0)
      store(none - (pending + to_the_right(left_before, left)), row.passing.carry, c - width);
    pending = straight + to_the_left(diagonal_before, diagonal);
    right_before = right;
    diagonal_before = diagonal;
    left_before = left;
    here = after;
    below_before = below;
    below = below_after;
  }
  store(none - (pending + to_the_right(left_before, none)), row.passing.carry, n - width);
}

template <bool Subtracted>
void stencil_times(int n, PlaneRows stencil, const ProductRow& row, Row3 out) {
  const std::ptrdiff_t block = block_entries * stencil.pitch;
  const Planes centre{stencil.first, stencil.pitch}, to_right{stencil.first + block, stencil.pitch},
      down{stencil.first + 2 * block, stencil.pitch},
      to_below_right{stencil.first + 3 * block, stencil.pitch},
      to_below_left{stencil.first + 4 * block, stencil.pitch};
  const Pack3 none{};
  Pack3 here = load(row.here, 0), below = load(row.below, 0), below_before = none;
  Pack3 right_before = none, diagonal_before = none, left_before = none, pending = none;
  for (int c = 0; c < n; c += width) {
    const Pack3 after = load(row.here, c + width), below_after = load(row.below, c + width);
    const Pack3 right = block_times(to_right, c, here);
    Pack3 sum = load(row.passing.carried, c) + block_times(centre, c, here);
    sum = sum + block_times(to_right, c, to_the_right(here, after)) +
          to_the_left(right_before, right);
    const Pack3 diagonal = block_times(to_below_right, c, here);
    sum = sum + block_times(to_below_right, c, to_the_right(below, below_after));
    const Pack3 left = block_times(to_below_left, c, here);
    sum = sum + block_times(to_below_left, c, to_the_left(below_before, below));
    put<Subtracted>(sum + block_times(down, c, below), row.rhs, out, c);
    if (c > 0) store(pending + to_the_right(left_before, left), row.passing.carry, c - width);
    pending = block_times(down, c, here) + to_the_left(diagonal_before, diagonal);
    right_before = right;
    diagonal_before = diagonal;
    left_before = left;
    here = after;
    below_before = below;
    below = below_after;
  }
  store(pending + to_the_right(left_before, none), row.passing.carry, n - width);
}

}  // namespace

void apply_springs(int n, PlaneRows springs, const float* mass, const ProductRow& row, Row3 out) {
  if (row.rhs.x == nullptr)
    springs_times<false>(n, springs, mass, row, out);
  else
    springs_times<true>(n, springs, mass, row, out);
}

void apply_stencil(int n, PlaneRows stencil, const ProductRow& row, Row3 out) {
  if (row.rhs.x == nullptr)
    stencil_times<false>(n, stencil, row, out);
  else
    stencil_times<true>(n, stencil, row, out);
}

void add_block_row(int n, PlaneRows blocks, float factor, ConstRow3 x, Row3 out) {
  const Planes block{blocks.first, blocks.pitch};
  const Pack by = Pack{} + factor;
  for (int c = 0; c < n; c += width)
    store(load(constant(out), c) + by * block_times(block, c, load(x, c)), out, c);
}

}  // namespace weft::WEFT_KERNEL_SET
