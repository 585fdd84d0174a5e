#include "weft/cloth/kernels/isa/packs.h"
#include "weft/cloth/kernels/isa/rows.h"

// Second differences of a row by the weights of its neighbours, and their transpose. Neighbours in
// the order of bending_offsets: right, left, below, above, below right, above left, below left,
// above right.
namespace weft::WEFT_KERNEL_SET {
namespace {

constexpr int straight_neighbours = 4;

[[gnu::always_inline]] inline Pack weight(PlaneRows weights, int neighbour, int c) {
  return load(weights.first + neighbour * weights.pitch + c);
}

template <bool Diagonals>
void second_differences(int n, PlaneRows weights, const RowTriple& x, Row3 u) {
  for (int c = 0; c < n; c += width) {
    const Pack3 at = load(x.here, c);
    const auto add = [&](Pack3 sum, int neighbour, ConstRow3 row, int shift) {
      return sum + weight(weights, neighbour, c) * (load(row, c + shift) - at);
    };
    Pack3 sum = weight(weights, 0, c) * (load(x.here, c + 1) - at);
    sum = add(sum, 1, x.here, -1);
    sum = add(sum, 2, x.below, 0);
    sum = add(sum, 3, x.above, 0);
    if constexpr (Diagonals) {
      sum = add(sum, 4, x.below, 1);
      sum = add(sum, 5, x.above, -1);
      sum = add(sum, 6, x.below, -1);
      sum = add(sum, 7, x.above, 1);
    }
    store(sum, u, c);
  }
}

template <bool Diagonals>
void transposed(int n, const BendingRows& weights, const RowTriple& u, float factor, Row3 out) {
  const Pack by = Pack{} + factor;
  for (int c = 0; c < n; c += width) {
    // The weight by which a neighbour sees these columns is one of its opposite.
    const auto back = [&](PlaneRows from, int neighbour, ConstRow3 row, int shift) {
      return weight(from, neighbour, c + shift) * load(row, c + shift);
    };
    Pack own = (weight(weights.here, 0, c) + weight(weights.here, 1, c)) +
               (weight(weights.here, 2, c) + weight(weights.here, 3, c));
    Pack3 sum = (back(weights.here, 1, u.here, 1) + back(weights.here, 0, u.here, -1)) +
                (back(weights.below, 3, u.below, 0) + back(weights.above, 2, u.above, 0));
    if constexpr (Diagonals) {
      own += (weight(weights.here, 4, c) + weight(weights.here, 5, c)) +
             (weight(weights.here, 6, c) + weight(weights.here, 7, c));
      sum = sum + (back(weights.below, 5, u.below, 1) + back(weights.above, 4, u.above, -1)) +
            (back(weights.below, 7, u.below, -1) + back(weights.above, 6, u.above, 1));
    }
    store(load(constant(out), c) + by * (sum - own * load(u.here, c)), out, c);
  }
}

}  // namespace

void bend(int n, PlaneRows weights, int neighbours, const RowTriple& x, Row3 u) {
  if (neighbours > straight_neighbours)
    second_differences<true>(n, weights, x, u);
  else
    second_differences<false>(n, weights, x, u);
}

void unbend(int n, const BendingRows& weights, const RowTriple& u, float factor, Row3 out) {
  if (weights.neighbours > straight_neighbours)
    transposed<true>(n, weights, u, factor, out);
  else
    transposed<false>(n, weights, u, factor, out);
}

}  // namespace weft::WEFT_KERNEL_SET
