#pragma once

#include <algorithm>

#include "weft/contact.h"
#include "weft/grid.h"

namespace weft {

/// The point of a cloth that a contact constrains: sum of weights[i] * at(samples[i]).
inline Vec3d point_of(const Contact& contact, const Planes3& planes) {
  Vec3d point;
  for (std::size_t i = 0; i < contact.samples.size(); ++i)
    if (contact.weights[i] != 0)
      point += double{contact.weights[i]} * vec_cast<double>(planes.at(contact.samples[i]));
  return point;
}

/// The depth by which that point violates the contact, negative where it does not. [m]
inline double depth_of(const Contact& contact, const Planes3& planes) {
  return double{contact.offset} - dot(vec_cast<double>(contact.normal), point_of(contact, planes));
}

/// Displacement of a contact's point by a force on it, from what the same force does to each of its
/// samples: sum of w^2 y. Not less than a part of what it would be on its softest sample alone:
/// a point that lies nearly on a pinned sample would press without limit on the rest of its
/// triangle.
class PointCompliance {
 public:
  void add(double weight, double yields) {
    total_ += weight * weight * yields;
    softest_ = std::max(softest_, yields);
    largest_ = std::max(largest_, weight * weight);
  }
  [[nodiscard]] double value() const { return std::max(total_, min_part * softest_ * largest_); }

 private:
  static constexpr double min_part = 0.05;

  double total_ = 0, softest_ = 0, largest_ = 0;
};

/// Maximum speed at which a point that penetrates at the start of a step is pushed out, so that it
/// is not ejected. [m/s]
inline constexpr double max_exit_speed = 0.5;

/// The contact's offset, reduced where the point penetrates at the start of the step, so that it is
/// pushed out by at most `farthest`. [m]
inline double attainable_offset(const Contact& contact, const Planes3& start, double farthest) {
  const double before =
      depth_of(contact, start) - double{dot(contact.normal, contact.surface_displacement)};
  return contact.offset - (before > farthest ? before - farthest : 0);
}

}  // namespace weft
