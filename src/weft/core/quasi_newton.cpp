#include "weft/core/quasi_newton.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "weft/core/ordered_sum.h"

namespace weft {
namespace {

/// Number of past steps that are known.
constexpr std::size_t memory = 10;
/// What a step is to lower the value by, as a part of what the slope foretells.
constexpr double enough = 1e-4;
constexpr int max_halvings = 30;

/// The part of a direction that moves no point farther than a first step does.
double first_length(double first_step, const Vectors& direction) {
  double most = 0;
  for (const Vec2d& v : direction) most = std::max(most, length(v));
  return first_step / most;
}

Vectors difference(Vectors a, const Vectors& b) {
  add_scaled(a, -1, b);
  return a;
}

}  // namespace

double dot_of(const Vectors& a, const Vectors& b) {
  return lane_sum(static_cast<int>(a.size()), [&](int k) { return dot(a[k], b[k]); });
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

double descend(const std::function<double(const Vectors&, Vectors&)>& measure, Vectors& at,
               const DescentOptions& options) {
  Vectors gradient(at.size()), next_gradient(at.size()), next;
  double value = measure(at, gradient);
  QuasiNewton method;
  for (int step = 0; step < options.max_steps; ++step) {
    const Vectors direction = method.direction(gradient);
    const double slope = dot_of(direction, gradient);
    if (!(slope > 0)) break;
    double length = method.knows_nothing() ? first_length(options.first_step, direction) : 1;
    double lower = value;
    int halvings = 0;
    for (; halvings < max_halvings; ++halvings, length *= 0.5) {
      next = at;
      add_scaled(next, -length, direction);
      lower = measure(next, next_gradient);
      if (lower <= value - enough * length * slope) break;
    }
    if (halvings == max_halvings) {
      if (method.knows_nothing()) break;
      method.forget();
      continue;
    }
    method.learn(difference(next, at), difference(next_gradient, gradient));
    const bool still = value - lower < options.still * value;
    std::swap(at, next);
    std::swap(gradient, next_gradient);
    value = lower;
    if (still) break;
  }
  return value;
}

}  // namespace weft
