#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/newton/contact_gather.h"

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

}  // namespace weft
