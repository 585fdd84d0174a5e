#pragma once

#include <array>

#include "weft/vec.h"

namespace weft {

/// A contact constraint on a point of the cloth: dot(normal, p) >= offset for
/// p = sum of weights[i] * position(samples[i]). The interface between colliders, which find
/// contacts, and integrators, which solve with them.
/// Against an obstacle the weights sum to 1: (1, 0, 0, 0) for a particle, barycentric weights for a
/// point of an edge or a triangle. Between cloth and cloth the weights of the other side are
/// negative, so that they sum to 0 and the offset is a distance.
struct Contact {
  std::array<int, 4> samples{};  ///< row * n + col each; arbitrary where the weight is 0
  std::array<float, 4> weights{1, 0, 0, 0};
  Vec3f normal;                ///< unit, away from the obstacle or the negative side
  float offset = 0;            ///< at the end of the step [m]
  float friction = 0;          ///< Coulomb coefficient of the pair
  Vec3f surface_displacement;  ///< displacement of the obstacle's surface during the step [m]
  /// Recovery distance beyond the offset, by which a response may move the point without adding
  /// velocity or normal force [m].
  float lift = 0;
  /// Stiffness of a soft contact: the solve leaves a depth of force over stiffness, which is not
  /// corrected afterwards. 0: hard [N/m].
  float stiffness = 0;
  /// Factor on the stiffness that a solve gives a hard contact, or a struck one of layers.
  float firmness = 1;
};

/// The forces of a contact at the end of a step, kept for the next one.
struct PastContact {
  std::array<int, 4> samples{};  ///< as the contact's; -1 where its weight is 0
  int second = -1;               ///< the other cloth of a shared one, else -1
  Vec3f normal;                  ///< the contact's
  Vec3f friction;                ///< friction force on the contact's point [N]
  float force = 0;               ///< normal force, averaged over some steps [N]
  float acceleration = 0;        ///< of a slipping point, along its slip [m/s^2]
};

/// A contact between two cloths: samples with positive weights belong to the first cloth.
struct SharedContact {
  Contact contact;
  int first = 0, second = 0;  ///< the cloths
  /// The cloth that samples[k] belongs to.
  [[nodiscard]] int cloth_of(std::size_t k) const {
    return contact.weights[k] < 0 ? second : first;
  }
};

/// A contact for points that a filter held back, kept for the next steps.
struct StruckContact {
  SharedContact shared;   ///< of one cloth with itself or with a body: twice that cloth
  int body = -1;          ///< number of the body, from 0; -1: none
  Vec3f body_velocity;    ///< of its closest point [m/s]; the contact is where that begins a step
  double compliance = 0;  ///< inverse effective mass of its points [1/kg]
  Vec3f way;              ///< of its sides relative to each other since its normal was found [m]
};

}  // namespace weft
