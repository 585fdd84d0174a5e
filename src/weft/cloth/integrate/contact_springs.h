#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/row_pointers.h"
#include "weft/core/contact.h"
#include "weft/core/contact_uses.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Contacts as one-sided springs along their normals, of energy k/2 max(0, depth)^2: a point beyond
/// its half-space is pushed back by k times its depth, k several times what the cloth holds it by,
/// so that it comes to rest within a small part of a micrometre, while a point that leaves is not
/// held. The forces on a point's samples, weights[i] of it each, are computed by contact, then
/// gathered by sample. A class of mates is one particle: what a contact does to one of its samples
/// is shared out among all.
///
/// What was beyond the half-space when the step began is not pushed out of it at any speed.
class ContactSprings {
 public:
  /// @param cloth  kept by reference
  explicit ContactSprings(const Cloth& cloth);

  void clear();
  /// Knows of contacts, but heeds none yet.
  /// @param contacts  must stay until the last press
  /// @param farthest  what was deeper when the step began is pushed out by no more than this [m]
  void take(std::span<const Contact> contacts, double farthest = HUGE_VAL);

  // To be called by every worker of the team, of any size.

  /// Heeds, besides those that it heeds already, the contacts that may press: whose point is beyond
  /// the half-space, or touches it, when each of the two sides is where it presses more, at the
  /// start of the step or now. Ends with a barrier.
  /// @param inverse_diagonal  [n x n] of the filter, 0 where held [m/N]
  /// @return whether there were any such
  bool heed(const Planes3& start, const Planes3& now, const Grid<float>& inverse_diagonal,
            Worker& worker);
  /// Where particles are: at from + move + way * direction, the parts of the sum apart, since
  /// depths are so small that rounding positions would drown them. [m]
  struct Place {
    const Planes3 &from, &move, &direction;
    float way = 1;
  };
  /// Computes all forces. Ends with a barrier.
  void press(const Place& place, Worker& worker);

  /// Whether no contact is heeded.
  [[nodiscard]] bool empty() const { return heeded_ == 0; }
  /// Whether a row has contacts that are heeded.
  [[nodiscard]] bool row(int r) const { return rows_[static_cast<std::size_t>(r)] != 0; }
  /// Adds each sample's own part of the forces to a row.
  void add_force(int row, Row3 force) const;
  /// Adds to a row each sample's own part of 3 x 3 blocks (xx, xy, xz, yy, yz, zz) that together
  /// bound the second derivative from above: w w^T is at most sum |w| times the diagonal of |w|, so
  /// a sample gets k sum |w| |w_i| n n^T. [N/m]
  void add_blocks(int row, const std::array<float*, 6>& block) const;

  /// Of each contact, in the order in which they were taken [N/m]; 0 where it is not heeded.
  [[nodiscard]] std::span<const float> stiffness() const { return stiffness_; }
  /// Of each contact, from the last press [N].
  [[nodiscard]] std::span<const float> forces() const { return force_; }

 private:
  void use(int sample, ContactUses::Use use);
  [[nodiscard]] bool may_press(const Contact& contact, const Planes3& start,
                               const Planes3& now) const;
  [[nodiscard]] double depth_at(int contact, const Place& place) const;
  void mark_rows(Worker& worker);

  const Cloth& cloth_;
  std::vector<int> class_at_;  // of border positions, -1 where a sample is alone
  std::span<const Contact> contacts_;
  double farthest_ = HUGE_VAL;  // [m]
  ContactUses uses_;
  std::vector<int> row_starts_;  // [n + 1] into uses_.samples()
  std::vector<float> stiffness_, force_;
  std::vector<double> offset_;  // that is held, where heeded [m]
  std::vector<char> rows_;
  int heeded_ = 0;
  bool grown_ = false;
};

}  // namespace weft
