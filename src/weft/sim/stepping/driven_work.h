#pragma once

#include <span>
#include <vector>

#include "weft/cloth/bending.h"
#include "weft/cloth/spring_rows.h"
#include "weft/contact.h"

namespace weft {

/// A step of a cloth that was done.
struct DoneStep {
  const ClothState &start, &end;
  double time_step = 0;  ///< [s]
};

/// Contacts with bodies and the ground, and what each pressed with where a solve told; else empty.
struct PressingObstacles {
  std::span<const Contact> contacts;
  std::span<const float> forces;  ///< [N]
};

/// The work that pins and moving bodies do on a cloth in a step: what they press with times how far
/// they go. What they press with is what a particle's change of momentum leaves unexplained by the
/// cloth's own forces, as they are at the step's end, and gravity:
///   W = sum over held and touched particles of (m (v1 - v0) / h - f(x1) - m g) . way
/// On a touched particle other layers press, too. So a body's normal force is what the solve says,
/// or that reaction where it is more, never a pull, and along its surface no more than friction.
class DrivenWork {
 public:
  /// @param cloth  kept by reference, as is the team
  DrivenWork(const Cloth& cloth, Vec3d gravity, ThreadTeam& team);

  /// @return of all pins and bodies [J]
  double measure(const DoneStep& step, const PressingObstacles& obstacles) noexcept;

 private:
  /// A particle that something moves.
  struct Driven {
    Vec3d displacement, normal;  // summed by weight [m]
    double pressing = 0;         // the same [N]
    double friction = 0;
    double weight = 0;
    bool pinned = false;
  };
  void add_pins(const DoneStep& step);
  void add_contacts(const PressingObstacles& obstacles);
  [[nodiscard]] static Vec3d force_on(const Driven& driven, Vec3d reaction);
  Driven& driven(int sample);
  void find_forces(const DoneStep& step);

  const Cloth& cloth_;
  Vec3d gravity_;
  ThreadTeam& team_;
  SpringRows springs_;
  BendingPass bending_;
  Planes3 force_;               // [n x n] of the cloth itself, summed over mates [N]
  std::vector<Driven> driven_;  // [n * n], in use where samples_ says
  std::vector<int> samples_;    // representatives that are driven
};

}  // namespace weft
