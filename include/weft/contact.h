#pragma once

#include <array>

#include "weft/vec.h"

namespace weft {

/// A half-space that a point of the cloth must not enter, found by a collider and heeded by an
/// integrator, which do not know each other: dot(normal, p) >= offset for
/// p = sum of weights[i] * position(samples[i]).
/// Against an obstacle the weights sum to 1: (1, 0, 0, 0) for a particle, several for a point of an
/// edge or a triangle. Between two parts of one cloth those of the other side are negative, so that
/// they sum to 0 and the offset is a distance.
struct Contact {
  std::array<int, 4> samples{};  ///< row * n + col each; where the weight is 0, any
  std::array<float, 4> weights{1, 0, 0, 0};
  Vec3f normal;                ///< unit, away from the obstacle or the negative side
  float offset = 0;            ///< at the end of the step [m]
  float friction = 0;          ///< Coulomb coefficient of the pair
  Vec3f surface_displacement;  ///< how far the obstacle's surface moves there during the step [m]
  /// Beyond the offset, what a response may move the point without speeding it up or pressing [m].
  float lift = 0;
  /// Of a soft contact: the solve gives way by force over stiffness, and what is left of its depth
  /// stays. 0: hard [N/m].
  float stiffness = 0;
};

/// What a contact did at the end of a step.
struct PastContact {
  std::array<int, 4> samples{};  ///< as the contact's; -1 where its weight is 0
  int second = -1;               ///< the other cloth of a shared one, else -1
  Vec3f normal;                  ///< the contact's
  Vec3f friction;                ///< on its point [N]
  float force = 0;               ///< along the normal, averaged over some steps [N]
  float acceleration = 0;        ///< of a point that slips, along its way [m/s^2]
};

/// One between two cloths: the samples of those with positive weights are the first one's.
struct SharedContact {
  Contact contact;
  int first = 0, second = 0;  ///< the cloths
  /// Whose samples[k] is one.
  [[nodiscard]] int cloth_of(std::size_t k) const {
    return contact.weights[k] < 0 ? second : first;
  }
};

}  // namespace weft
