#pragma once

#include <span>
#include <vector>

#include "weft/cloth/bending.h"
#include "weft/cloth/spring_rows.h"
#include "weft/contact.h"
#include "weft/sim/stepping/nearest_ways.h"

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

/// Work that pins and moving bodies do on a cloth in a step: the force that acts on a particle from
/// outside times how far what holds it goes. That force is the part of its change of momentum that
/// gravity and the cloth's own forces, as they are at the end given, do not explain:
///   W = sum over particles of (m (v1 - v0) / h - f(x1) - m g) . way
/// Solves end with small forces unbalanced on all particles, and stiff cloth hands on within a step
/// what holds it: all together they are of the size of what acts on the particles that are held. In
/// momentum only pins and obstacles act on cloth. So every particle counts, by the way of the pin
/// or obstacle that is nearest to it along the cloth and across its layers (NearestWays): forces
/// between particles cancel where these are held by the same, and layers above push through those
/// below. Where pins move differently and layers touch, that is not so for what pins hold: there
/// only the pins' own force counts. Where bodies press from several sides, each does the work of
/// its solved force by its own way, and the mean of their ways counts for the rest.
///
/// Springs that the filter stretched pull at the end of a step only: before the filter this
/// measures what the solve did, after it what the filter did too, but much too large.
class DrivenWork {
 public:
  /// @param cloth     kept by reference, as is the team
  /// @param stiffens  whether springs stiffen beyond the material's strain limit
  DrivenWork(const Cloth& cloth, Vec3d gravity, ThreadTeam& team, bool stiffens = false);

  /// Takes in what holds the cloth in a step. @return whether anything of it moves
  bool begin(const DoneStep& step, const PressingObstacles& obstacles) noexcept;
  /// Of what holds the cloth; to be spread before the work is measured.
  [[nodiscard]] NearestWays& ways() { return ways_; }
  /// What is counted of particles that are free.
  struct Free {
    bool any = true;       ///< false: as where a limiter pulls at them, whose work counts by itself
    bool layered = false;  ///< layers of the cloth touch each other, or another cloth's
  };
  /// @pre begin with the same step, and ways are spread
  /// @return work of all pins and bodies [J]
  [[nodiscard]] double measure(const DoneStep& step, Free free) noexcept;

 private:
  /// What touches a particle.
  struct Touch {
    Vec3d way;                 // weighted sum over contacts [m]
    Vec3d pressed;             // normal forces, weighted sum [N]
    double pressing_work = 0;  // of each by its own way [J]
    double weight = 0;
  };
  void add_pins(const DoneStep& step);
  void add_contact(const Contact& contact, double force);
  void find_forces(const DoneStep& step);
  [[nodiscard]] bool pins_move_alike() const;
  [[nodiscard]] double work_on(int sample, const DoneStep& step) const;
  [[nodiscard]] Vec3d reaction_on(int sample, const DoneStep& step) const;

  const Cloth& cloth_;
  Vec3d gravity_;
  ThreadTeam& team_;
  SpringRows springs_;
  BendingPass bending_;
  Planes3 force_;             // [n x n] the cloth's own, summed over mates [N]
  std::vector<Touch> touch_;  // [n * n] valid for touched_
  std::vector<int> touched_;  // representatives that obstacles touch and no pin holds
  std::vector<int> pinned_;   // representatives
  NearestWays ways_;
  bool moves_ = false;  // what holds the cloth
  bool stiffens_;
};

}  // namespace weft
