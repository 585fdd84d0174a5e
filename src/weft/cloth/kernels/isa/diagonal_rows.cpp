#include "weft/cloth/kernels/isa/packs.h"
#include "weft/cloth/kernels/isa/rows.h"

// Diagonal blocks of the Hessian of near springs.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// A sum of t 1 + s s^T.
struct BlockSum {
  Pack t, xx, xy, xz, yy, yz, zz;

  [[gnu::always_inline]] void add(Pack across, Pack x, Pack y, Pack z) {
    t += across;
    xx += x * x;
    xy += x * y;
    xz += x * z;
    yy += y * y;
    yz += y * z;
    zz += z * z;
  }
  /// The springs of a direction that start from columns c on. @param shift  of the columns
  [[gnu::always_inline]] void add(PlaneRows springs, int direction, int c, int shift) {
    const float* first = springs.first + direction * spring_entries * springs.pitch + c + shift;
    add(load(first), load(first + springs.pitch), load(first + 2 * springs.pitch),
        load(first + 3 * springs.pitch));
  }
};

[[gnu::always_inline]] inline BlockSum operator+(const BlockSum& a, const BlockSum& b) {
  return {a.t + b.t, a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}

[[gnu::always_inline]] inline void put(const BlockSum& sum, Pack beside, MutablePlaneRows to,
                                       int c) {
  const Pack on_diagonal = sum.t + beside;
  float* first = to.first + c;
  store(sum.xx + on_diagonal, first);
  store(sum.xy, first + to.pitch);
  store(sum.xz, first + 2 * to.pitch);
  store(sum.yy + on_diagonal, first + 3 * to.pitch);
  store(sum.yz, first + 4 * to.pitch);
  store(sum.zz + on_diagonal, first + 5 * to.pitch);
}

}  // namespace

void line_diagonals(int n, PlaneRows springs, PlaneRows above, const float* mass,
                    const float* extra, const LineDiagonals& out) {
  for (int c = 0; c < n; c += width) {
    BlockSum shear{}, row{}, col{};
    shear.add(springs, 2, c, 0);
    shear.add(above, 2, c, -1);
    shear.add(springs, 3, c, 0);
    shear.add(above, 3, c, 1);
    row.add(springs, 0, c, 0);
    row.add(springs, 0, c, -1);
    col.add(springs, 1, c, 0);
    col.add(above, 1, c, 0);
    const Pack inertia = load(mass + c);
    put(shear + row + col, inertia, out.whole, c);
    if (out.rows.first == nullptr) continue;
    const Pack beside = inertia + load(extra + c);
    put(shear + col, beside, out.rows, c);
    put(shear + row, beside, out.cols, c);
  }
}

}  // namespace weft::WEFT_KERNEL_SET
