#include "weft/garment/quasi_newton.h"

#include <cstddef>
#include <utility>

namespace weft {
namespace {

/// Number of past steps that are known.
constexpr std::size_t memory = 10;

}  // namespace

double dot_of(const Vectors& a, const Vectors& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += dot(a[k], b[k]);
  return sum;
}

void add_scaled(Vectors& to, double factor, const Vectors& what) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] = to[k] + factor * what[k];
}

Vectors QuasiNewton::direction(const Vectors& gradient) const {
  Vectors d = gradient;
  std::vector<double> part(pairs_.size());
  for (std::size_t k = pairs_.size(); k-- > 0;) {
    part[k] = dot_of(pairs_[k].moved, d) / pairs_[k].product;
    add_scaled(d, -part[k], pairs_[k].turned);
  }
  if (!pairs_.empty()) {
    const Pair& last = pairs_.back();
    const double scale = last.product / dot_of(last.turned, last.turned);
    for (Vec2d& v : d) v = scale * v;
  }
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    add_scaled(d, part[k] - dot_of(pairs_[k].turned, d) / pairs_[k].product, pairs_[k].moved);
  return d;
}

void QuasiNewton::learn(Vectors moved, Vectors turned) {
  const double product = dot_of(moved, turned);
  if (!(product > 0)) return;
  pairs_.push_back({std::move(moved), std::move(turned), product});
  if (pairs_.size() > memory) pairs_.pop_front();
}

}  // namespace weft
