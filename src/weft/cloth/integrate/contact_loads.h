#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/row_pointers.h"
#include "weft/core/contact.h"
#include "weft/core/contact_uses.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Contacts as springs between their samples, whatever decides how hard they press: a stiffness and
/// a load a contact, of which each sample gets its weight's part, gathered in a fixed order. A
/// class of mates is one particle: what a contact does to one of its samples is shared out among
/// all.
class ContactLoads {
 public:
  /// @param cloth  kept by reference
  explicit ContactLoads(const Cloth& cloth);

  /// Takes the place of the contacts before; none of them is stiff as yet.
  /// @param contacts  must stay until the last use
  void take(std::span<const Contact> contacts);
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
  [[nodiscard]] bool row(int r) const { return rows_[static_cast<std::size_t>(r)] != 0; }

  /// Adds each sample's own part of the loads to a row.
  void add_row(int row, Row3 out) const;
  /// Adds to a row each sample's own part of 3 x 3 blocks (xx, xy, xz, yy, yz, zz) that together
  /// bound the springs' matrix from above: w w^T is at most sum |w| times the diagonal of |w|, so a
  /// sample gets sum |w| |w_i| times stiffness * n n^T + grip * (1 - n n^T).
  void add_blocks(int row, const std::array<float*, 6>& block) const;

  /// The stiffness of what holds a contact's point against a push along its normal: springs of 1 /
  /// inverse diagonal at its samples, one behind the other. 0 where nothing moves.
  static double own_stiffness(const Contact& contact, const Grid<float>& inverse_diagonal);

 private:
  void use(int sample, ContactUses::Use use);

  const Cloth& cloth_;
  std::vector<int> class_at_;  // of border positions, -1 where a sample is alone
  std::span<const Contact> contacts_;
  ContactUses uses_;
  std::vector<int> row_starts_;  // [n + 1] into uses_.samples()
  std::vector<float> stiffness_, grip_;
  std::vector<Vec3f> load_;
  std::vector<char> rows_;
  int stiff_ = 0;
};

}  // namespace weft
