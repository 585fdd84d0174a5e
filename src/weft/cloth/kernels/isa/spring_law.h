#pragma once

#include <cmath>

#include "weft/cloth/kernels/isa/packs.h"

namespace weft::WEFT_KERNEL_SET {
namespace {

/// Lower bound of a spring's squared length, which keeps its direction finite. [m^2]
constexpr float min_squared_length = 1e-24F;

[[gnu::always_inline]] inline float larger(float a, float b) { return a > b ? a : b; }
[[gnu::always_inline]] inline float root(float a) { return std::sqrt(a); }
/// Exact to the last bit, as all square roots of these processors.
[[gnu::always_inline]] inline Pack root(Pack a) {
  Pack roots;
  for (int i = 0; i < width; ++i) roots[i] = __builtin_sqrtf(a[i]);
  return roots;
}

/// Of one number or of a pack of them.
template <class T>
struct Vector {
  T x, y, z;
};
template <class T>
[[gnu::always_inline]] inline T dot_of(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A spring and its bounds, as in LinearisedSprings.
template <class T>
struct SpringTerms {
  T rest, stiffness, damping;
  T limit, limit_factor;
};

/// The differences of both ends' positions, velocities and positions at the start of the step.
template <class T>
struct SpringEnds {
  Vector<T> apart, approach, before;
};

/// As in SpringHessianRow.
template <class T>
struct SpringHessianTerms {
  T across, force;
  Vector<T> along;
};

template <class T>
[[gnu::always_inline]] inline SpringHessianTerms<T> linearise_spring(const SpringTerms<T>& spring,
                                                                     const SpringEnds<T>& ends,
                                                                     float per_step,
                                                                     float guessed_share) {
  const T none{}, least = none + min_squared_length;
  const T squared = larger(dot_of(ends.apart, ends.apart), least);
  const T inverse = 1 / root(squared);
  const T ratio = spring.rest * inverse, k = spring.stiffness;
  const T over = larger(1 - spring.limit * ratio, none);
  const T limiting = spring.limit_factor * k;
  const T stiffer = over > 0 ? limiting : none;
  const T tension = k * (1 - ratio) + limiting * over;
  const T squared_before = larger(dot_of(ends.before, ends.before), least);
  const T held = k * (1 - spring.rest / root(squared_before));
  const T across = larger(larger(held, guessed_share * tension), none);
  const T damping = spring.damping * per_step;
  const T axial = larger(k + stiffer + damping - across, none);
  const T s = root(axial) * inverse;
  return {across,
          tension + spring.damping * dot_of(ends.apart, ends.approach) * (inverse * inverse),
          {s * ends.apart.x, s * ends.apart.y, s * ends.apart.z}};
}

/// As NewtonKernels::near_energy.
template <class T>
[[gnu::always_inline]] inline T spring_energy_of(const SpringTerms<T>& spring,
                                                 const Vector<T>& apart, const Vector<T>& approach,
                                                 float step) {
  const T none{};
  const T squared = larger(dot_of(apart, apart), none + min_squared_length);
  const T length = root(squared);
  const T elongation = length - spring.rest,
          over = larger(length - spring.limit * spring.rest, none);
  const T closing = dot_of(apart, approach);
  return 0.5F *
         (spring.stiffness * (elongation * elongation + spring.limit_factor * (over * over)) +
          step * spring.damping * (closing * closing) / squared);
}

}  // namespace
}  // namespace weft::WEFT_KERNEL_SET
