#pragma once

#include <span>
#include <vector>

#include "weft/cloth/integrate/contact_loads.h"
#include "weft/cloth/integrate/integrator.h"
#include "weft/cloth/newton/padded_planes.h"

namespace weft {

/// Contacts and Coulomb friction as part of a linearised step: a contact that presses holds its
/// point at its half-space by a stiff spring along the normal; one that sticks holds it there too,
/// one that slips drags on it with its coefficient times the normal force. All are linear in the
/// step's unknown until choose() looks again, as in the lagged friction of [li20].
///
/// What was beyond the half-space when the step began is not pushed out of it at any speed.
class ContactSystem {
 public:
  /// @param cloth  kept by reference
  explicit ContactSystem(const Cloth& cloth);

  /// Takes the place of the contacts before. @param contacts  must stay until the last use
  /// @param start  positions when the step began [m]
  void take(std::span<const Contact> contacts, const Planes3& start, const StepInput& input);
  [[nodiscard]] bool empty() const { return loads_.contacts().empty(); }

  // To be called by every worker of the team; each ends with a barrier.

  /// Where points are at the linearisation. @param velocity  that leads there from the start [m/s]
  /// @param diagonal  the springs' diagonal blocks, summed over seam copies [N/m]
  void place(const PaddedVectors& velocity, const PaddedBlocks& diagonal, Worker& worker);
  /// Decides which contacts press, and which stick, where a step from the linearisation leads;
  /// the first time where it would lead without forces of the cloth.
  /// @return whether any is taken otherwise than before
  bool choose(const PaddedVectors& step, Worker& worker);
  /// The loads become the forces after a step [N].
  void load_forces(const PaddedVectors& step, Worker& worker);
  /// The loads become the contacts' part of the Hessian times a direction [N].
  void load_product(const PaddedVectors& direction, Worker& worker);
  /// The energy of all contacts, whose points are beyond their half-spaces after a part of a step,
  /// and of friction as it is taken; all workers get it [J].
  double energy(const PaddedVectors& step, float part, Worker& worker);
  /// Computes the normal forces after a step.
  void measure(const PaddedVectors& step, Worker& worker);

  /// Of each contact, in the order in which they were taken [N].
  [[nodiscard]] std::span<const float> forces() const { return force_; }
  [[nodiscard]] const ContactLoads& loads() const { return loads_; }
  /// How many press.
  [[nodiscard]] int active() const { return loads_.stiff(); }

 private:
  [[nodiscard]] Vec3d sum(const Contact& contact, const PaddedVectors& field) const;
  [[nodiscard]] double lone_compliance(const Contact& contact) const;
  /// How a contact's point moved along its obstacle.
  struct Sliding {
    double depth, way;  ///< [m]
    bool pressed;       ///< whether it was held along the normal as the point moved so
    double grip;        ///< by which it was held along the surface [N/m]
  };
  [[nodiscard]] double grip_for(int index, const Sliding& sliding) const;
  bool choose(int index, const PaddedVectors& step);
  [[nodiscard]] double depth_after(int index, Vec3d step) const;
  [[nodiscard]] Vec3d slid_after(int index, Vec3d step) const;

  const Cloth& cloth_;
  ContactLoads loads_;
  const Planes3* start_ = nullptr;
  StepInput input_;
  bool first_ = true;
  std::vector<double> depth_;     // at the linearisation [m]
  std::vector<double> lift_;      // of that, what only raises the point [m]
  std::vector<Vec3d> slid_;       // along the obstacle, relative to it [m]
  std::vector<float> stiffness_;  // of each when it presses [N/m]
  std::vector<float> force_;
  std::vector<double> energy_;
  std::vector<char> changed_;
  Grid<float> inverse_diagonal_;  // [m/N]
  bool any_changed_ = false;
};

}  // namespace weft
