#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/newton/contact_gather.h"
#include "weft/contact.h"

namespace weft {

/// Contacts of one cloth as springs between their samples, whatever decides how hard they press: a
/// stiffness and a load a contact, gathered to samples by ContactGather.
class ContactLoads {
 public:
  /// @param cloth  kept by reference
  explicit ContactLoads(const Cloth& cloth) : cloth_(cloth), gather_(cloth) {}

  /// Takes the place of the contacts before; none of them is stiff as yet.
  /// @param contacts  must stay until the last use
  void set_contacts(std::span<const Contact> contacts);
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }
  /// Of each contact along its normal, 0: it does nothing. [N/m], [kg] or the like
  [[nodiscard]] std::span<float> stiffness() { return stiffness_; }
  [[nodiscard]] std::span<const float> stiffness() const { return stiffness_; }
  /// The same against sliding.
  [[nodiscard]] std::span<float> grip() { return grip_; }
  /// Of each contact on its point, in any unit.
  [[nodiscard]] std::span<Vec3f> loads() { return load_; }

  /// To be called by every worker of the team when any stiffness has changed. Begins and ends with
  /// a barrier.
  void count(Worker& worker);
  /// How many contacts are stiff.
  [[nodiscard]] int stiff() const { return stiff_; }
  /// Whether a row has stiff contacts.
  [[nodiscard]] bool row(int r) const { return gather_.row(r); }

  /// See ContactGather.
  void add_row(int row, Row3 out) const { gather_.add_row(row, load_, out); }
  void add_blocks(int row, const std::array<float*, 6>& block) const {
    gather_.add_blocks(row, {contacts_, stiffness_, grip_}, block);
  }

  /// The stiffness of what holds a contact's point against a push along its normal: springs of 1 /
  /// inverse diagonal at its samples, one behind the other. 0 where nothing moves.
  static double own_stiffness(const Contact& contact, const Grid<float>& inverse_diagonal);

 private:
  const Cloth& cloth_;
  ContactGather gather_;
  std::span<const Contact> contacts_;
  std::vector<float> stiffness_, grip_;
  std::vector<Vec3f> load_;
  int stiff_ = 0;
};

/// Contacts as part of implicit Euler's system: the point of a contact that presses is held to its
/// surface by a spring along the normal, an eighth as stiff as what the cloth holds it by. In terms
/// of the velocity v at the end of the step the term of a contact is
///   k (w n) (w n)^T v = k (w n) t,   t = how far the point may go along n, over h.
/// Which contacts hold is found by turns: after a solve those that it violates join and those that
/// would pull leave.
class ContactTerms {
 public:
  /// @param cloth  kept by reference
  explicit ContactTerms(const Cloth& cloth);

  /// Forgets all contacts.
  void clear() { loads_.set_contacts({}); }
  /// None of them holds as yet. @param contacts  must stay until the last use
  /// @param start  positions at the start of the step [m]
  void set_contacts(std::span<const Contact> contacts, const Planes3& start, double time_step);

  // To be called by every worker; each ends with a barrier.

  /// Chooses anew which contacts hold. @param diagonal  blocks of the cloth's own, summed over
  /// mates
  /// @return whether that changed
  bool choose(const Planes3& velocity, const Blocks& diagonal, Worker& worker);
  /// The loads become the right side's. [kg m/s]
  void aim(Worker& worker);
  /// The loads become the terms' product with velocities. [kg m/s]
  void multiply(const Planes3& velocity, Worker& worker);
  /// Computes the forces that a solution stands for.
  void measure(const Planes3& velocity, Worker& worker);

  [[nodiscard]] bool empty() const { return loads_.stiff() == 0; }
  /// Holding contacts are stiff [kg].
  [[nodiscard]] const ContactLoads& loads() const { return loads_; }
  /// What bounds the terms on the system's diagonal, summed over mates; where none holds, anything.
  [[nodiscard]] const Blocks& blocks() const { return blocks_; }
  /// Of each contact, in the order in which they were taken [N].
  [[nodiscard]] std::span<const float> forces() const { return force_; }

 private:
  [[nodiscard]] double speed(int contact, const Planes3& velocity) const;
  void renew_blocks(Worker& worker);

  const Cloth& cloth_;
  ContactLoads loads_;
  double time_step_ = 0;        // [s]
  std::vector<double> target_;  // t [m/s]
  std::vector<float> force_;
  std::vector<char> changed_;  // of each contact: whether it joined or left
  bool any_changed_ = false;
  Grid<float> inverse_diagonal_;  // [1/kg]
  Blocks blocks_;
};

}  // namespace weft
