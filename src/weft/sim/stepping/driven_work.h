#pragma once

#include <optional>
#include <span>
#include <vector>

#include "weft/cloth/bending.h"
#include "weft/cloth/spring_rows.h"
#include "weft/contact.h"

namespace weft {

/// States of a cloth at both ends of a step.
struct DoneStep {
  const ClothState &start, &end;
  double time_step = 0;  ///< [s]
};

/// Contacts with bodies and the ground, and their normal forces; no forces where no solve gave any.
struct PressingObstacles {
  std::span<const Contact> contacts;
  std::span<const float> forces;  ///< [N]
};

/// Work that pins and moving bodies do on a cloth in a step: reaction force times displacement. The
/// reaction is the part of a particle's change of momentum that gravity and the cloth's own forces,
/// as they are at the end given, do not explain:
///   W = sum over pinned and touched particles of (m (v1 - v0) / h - f(x1) - m g) . displacement
/// Other layers may press on a touched particle, too. The normal force of a body is therefore the
/// solved one, or the normal part of the reaction where that is larger, and never a pull; the
/// tangential force is limited by friction. Springs that the filter stretched pull at the end of a
/// step only: before the filter this measures what the solve did, after it what the filter did too,
/// but much too large. Where bodies press from several sides, each does the work of its solved
/// force by its own way; what else moves the particle is friction.
///
/// Solves end with small forces unbalanced on free particles, too. Next to the pins' own reaction
/// they are small, but stiff cloth hands on within a step what a pin does: all together they are of
/// its size. They belong to the pins: in momentum, only pins and obstacles act on a cloth. While a
/// cloth touches nothing, the force left on a free particle counts as the nearest pin's. Where pins
/// move alike, a solve that knows its contact forces has all that from the cloth's momentum.
class DrivenWork {
 public:
  /// @param cloth     kept by reference, as is the team
  /// @param stiffens  whether springs stiffen beyond the material's strain limit
  DrivenWork(const Cloth& cloth, Vec3d gravity, ThreadTeam& team, bool stiffens = false);

  /// To be called before measure, where more than springs and gravity acts on free particles in the
  /// step: contacts, or a strain limiter, whose pull counts by itself.
  void ignore_free() { ignores_free_ = true; }
  /// @param pin_force  of all pins, where the solve knows it [N]
  /// @return work of all pins and bodies [J]
  double measure(const DoneStep& step, const PressingObstacles& obstacles,
                 std::optional<Vec3d> pin_force = {}) noexcept;

 private:
  /// A particle moved by a pin or bodies.
  struct Driven {
    Vec3d displacement, normal;  // weighted sums over contacts [m]
    double pressing = 0;         // normal force, weighted sum [N]
    Vec3d pressed;               // the same with directions [N]
    double pressing_work = 0;    // of each by its own displacement [J]
    double friction = 0;
    double weight = 0;
    bool pinned = false;
  };
  void add_pins(const DoneStep& step);
  void add_contacts(const PressingObstacles& obstacles);
  double work_of_pins(const DoneStep& step, const std::optional<Vec3d>& force);
  [[nodiscard]] Vec3d mean_pin_displacement() const;
  [[nodiscard]] static double work_of(const Driven& driven, Vec3d reaction);
  Driven& driven(int sample);
  void find_forces(const DoneStep& step);
  void find_nearest_pins();
  [[nodiscard]] Vec3d reaction_on(int sample, const DoneStep& step) const;
  double work_on_free(const DoneStep& step);

  const Cloth& cloth_;
  Vec3d gravity_;
  ThreadTeam& team_;
  SpringRows springs_;
  BendingPass bending_;
  Planes3 force_;               // [n x n] the cloth's own, summed over mates [N]
  std::vector<Driven> driven_;  // [n * n] valid for samples_
  std::vector<int> samples_;    // representatives moved by pins or bodies
  bool stiffens_;
  bool ignores_free_ = false;
  std::vector<int> pins_;     // for which nearest_ was found, representatives
  std::vector<int> nearest_;  // [n * n] of representatives: the pin that is nearest along the cloth
  std::vector<int> class_of_;  // [n * n] the class of mates of each sample, -1: it has none
  std::vector<int> front_;     // scratch
};

}  // namespace weft
