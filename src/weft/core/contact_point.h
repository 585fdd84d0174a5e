#pragma once

#include "weft/core/contact.h"
#include "weft/core/planes.h"

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

}  // namespace weft
