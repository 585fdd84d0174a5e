#include "weft/cloth/kernels/isa/packs.h"
#include "weft/cloth/kernels/isa/rows.h"

// Vector operations of conjugate gradients. Rows have whole vectors of 16 columns.
namespace weft::WEFT_KERNEL_SET {
namespace {

/// Sums have this many lanes whatever the vector's width, so that they round alike.
constexpr int lanes = 16, packs = lanes / width;

/// A sum over a row by lanes.
struct LaneSum {
  Pack sums[packs] = {};

  [[nodiscard]] double total() const {
    double halves[lanes];
    for (int i = 0; i < lanes; ++i) halves[i] = double{sums[i / width][i % width]};
    for (int half = lanes / 2; half > 0; half /= 2)
      for (int i = 0; i < half; ++i) halves[i] += halves[i + half];
    return halves[0];
  }
};

/// Calls visit(column, pack of the lanes) for the packs of a row.
template <class Visit>
[[gnu::always_inline]] inline void for_packs(int n, const Visit& visit) {
  for (int c = 0; c < n; c += lanes)
    for (int p = 0; p < packs; ++p) visit(c + p * width, p);
}

}  // namespace

void scale_row(int n, float factor, Row3 out) {
  const Pack by = Pack{} + factor;
  for (int c = 0; c < n; c += width) store(by * load(constant(out), c), out, c);
}

void add_scaled(int n, float factor, ConstRow3 a, Row3 out) {
  const Pack by = Pack{} + factor;
  for (int c = 0; c < n; c += width) store(load(constant(out), c) + by * load(a, c), out, c);
}

double newton_dot(int n, const float* share, ConstRow3 a, ConstRow3 b) {
  LaneSum sum;
  if (share == nullptr)
    for_packs(n, [&](int c, int p) { sum.sums[p] += dot(load(a, c), load(b, c)); });
  else
    for_packs(n,
              [&](int c, int p) { sum.sums[p] += load(share + c) * dot(load(a, c), load(b, c)); });
  return sum.total();
}

double update(int n, const float* share, ConstRow3 z, float factor, ConstRow3 residual,
              Row3 direction) {
  const Pack by = Pack{} + factor;
  LaneSum sum;
  for_packs(n, [&](int c, int p) {
    const Pack3 next = load(z, c) + by * load(constant(direction), c);
    store(next, direction, c);
    const Pack product = dot(load(residual, c), next);
    sum.sums[p] += share == nullptr ? product : load(share + c) * product;
  });
  return sum.total();
}

float advance(int n, float length, ConstRow3 direction, ConstRow3 product, Row3 step,
              Row3 residual) {
  const Pack by = Pack{} + length;
  Pack largest{};
  for (int c = 0; c < n; c += width) {
    const Pack3 d = load(direction, c);
    store(load(constant(step), c) + by * d, step, c);
    store(load(constant(residual), c) - by * load(product, c), residual, c);
    largest = larger(dot(d, d), largest);
  }
  // The largest is the same in any order.
  float maximum = 0;
  for (int i = 0; i < width; ++i) maximum = largest[i] > maximum ? largest[i] : maximum;
  return maximum;
}

}  // namespace weft::WEFT_KERNEL_SET
