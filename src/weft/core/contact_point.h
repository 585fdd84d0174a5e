#pragma once

#include "weft/contact.h"
#include "weft/grid.h"

namespace weft {

/// The point of a cloth that a contact is about: sum of weights[i] * at(samples[i]).
inline Vec3d point_of(const Contact& contact, const Planes3& planes) {
  Vec3d point;
  for (std::size_t i = 0; i < contact.samples.size(); ++i)
    if (contact.weights[i] != 0)
      point += double{contact.weights[i]} * vec_cast<double>(planes.at(contact.samples[i]));
  return point;
}

/// How far that point is beyond the half-space, negative before it. [m]
inline double depth_of(const Contact& contact, const Planes3& planes) {
  return double{contact.offset} - dot(vec_cast<double>(contact.normal), point_of(contact, planes));
}

/// What is inside something when a step begins, having been put or pressed there, leaves at this
/// speed at most, lest it be shot out. [m/s]
inline constexpr double max_exit_speed = 0.5;

/// The offset that a step may bring about, in which nothing that was beyond the half-space when the
/// step began is pushed out of it by more than `farthest`.
inline double attainable_offset(const Contact& contact, const Planes3& start, double farthest) {
  const double before =
      depth_of(contact, start) - double{dot(contact.normal, contact.surface_displacement)};
  return contact.offset - (before > farthest ? before - farthest : 0);
}

}  // namespace weft
