#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/baselines/contact_gather.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/contact.h"

namespace weft {

/// Contacts of one cloth as springs between their samples: a stiffness and a load for each, set by
/// the user of the class and gathered to samples by ContactGather.
class ContactLoads {
 public:
  /// @param cloth  kept by reference
  explicit ContactLoads(const Cloth& cloth) : cloth_(cloth), gather_(cloth) {}

  /// Replaces all contacts; none has a stiffness yet.
  /// @param contacts  must stay until the last use
  void set_contacts(std::span<const Contact> contacts);
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }
  /// Stiffness of each contact along its normal, 0: inactive. [N/m], [kg] or the like
  [[nodiscard]] std::span<float> stiffness() { return stiffness_; }
  [[nodiscard]] std::span<const float> stiffness() const { return stiffness_; }
  /// Tangential stiffness of each contact.
  [[nodiscard]] std::span<float> grip() { return grip_; }
  /// Load of each contact on its point, in any unit.
  [[nodiscard]] std::span<Vec3f> loads() { return load_; }

  /// Counts the active contacts and marks their rows. To be called by every worker of the team when
  /// any stiffness has changed. Begins and ends with a barrier.
  void count(Worker& worker);
  /// Number of active contacts, whose stiffness is above 0.
  [[nodiscard]] int stiff() const { return stiff_; }
  /// Whether a row has active contacts.
  [[nodiscard]] bool row(int r) const { return gather_.row(r); }

  /// See ContactGather.
  void add_row(int row, Row3 out) const { gather_.add_row(row, load_, out); }
  void add_blocks(int row, const std::array<float*, 6>& block) const {
    gather_.add_blocks(row, {contacts_, stiffness_, grip_}, block);
  }

  /// The stiffness by which the cloth holds a contact's point against a push along its normal:
  /// springs of 1 / inverse diagonal at its samples, in series. 0 where nothing moves.
  static double own_stiffness(const Contact& contact, const Grid<float>& inverse_diagonal);

 private:
  const Cloth& cloth_;
  ContactGather gather_;
  std::span<const Contact> contacts_;
  std::vector<float> stiffness_, grip_;
  std::vector<Vec3f> load_;
  int stiff_ = 0;
};

/// Contacts as part of implicit Euler's system: an active contact holds its point at its surface by
/// a spring along the normal, an eighth as stiff as the cloth holds the point. In terms of the
/// velocity v at the end of the step the term of a contact is
///   k (w n) (w n)^T v = k (w n) t,   t = how far the point may go along n, over h.
/// The active contacts are found by alternation: after a solve, contacts that it violates become
/// active and contacts that would pull become inactive.
class ContactTerms {
 public:
  /// @param cloth  kept by reference
  explicit ContactTerms(const Cloth& cloth);

  /// Forgets all contacts.
  void clear() { loads_.set_contacts({}); }
  /// Replaces all contacts; none is active yet. @param contacts  must stay until the last use
  /// @param start  positions at the start of the step [m]
  void set_contacts(std::span<const Contact> contacts, const Planes3& start, double time_step);

  // To be called by every worker; each ends with a barrier.

  /// Updates which contacts are active.
  /// @param diagonal  blocks of the cloth's own, summed over mates
  /// @return whether that changed
  bool choose(const Planes3& velocity, const Blocks& diagonal, Worker& worker);
  /// Sets the loads to the contacts' part of the right side. [kg m/s]
  void aim(Worker& worker);
  /// Sets the loads to the product of the contacts' terms with velocities. [kg m/s]
  void multiply(const Planes3& velocity, Worker& worker);
  /// Computes the contact forces of a solution.
  void measure(const Planes3& velocity, Worker& worker);

  [[nodiscard]] bool empty() const { return loads_.stiff() == 0; }
  /// Active contacts have a stiffness [kg].
  [[nodiscard]] const ContactLoads& loads() const { return loads_; }
  /// Diagonal blocks that bound the contacts' terms, summed over mates; undefined if none is
  /// active.
  [[nodiscard]] const Blocks& blocks() const { return blocks_; }
  /// Normal force of each contact, in the order of set_contacts [N].
  [[nodiscard]] std::span<const float> forces() const { return force_; }

 private:
  [[nodiscard]] double speed(int contact, const Planes3& velocity) const;
  void renew_blocks(Worker& worker);

  const Cloth& cloth_;
  ContactLoads loads_;
  double time_step_ = 0;        // [s]
  std::vector<double> target_;  // t [m/s]
  std::vector<float> force_;
  std::vector<char> changed_;  // whether each contact became active or inactive
  bool any_changed_ = false;
  Grid<float> inverse_diagonal_;  // [1/kg]
  Blocks blocks_;
};

}  // namespace weft
