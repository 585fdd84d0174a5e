#pragma once

#include <span>

#include "weft/cloth/integrate/spring_matrix.h"
#include "weft/core/contact.h"

namespace weft {

/// Contacts as part of implicit Euler's system: a particle whose proposal is beyond its half-space
/// is held to its surface by a spring along the normal that is `contact_stiffness` times stiffer
/// than the particle's own diagonal block. In terms of the velocity v at the end of the step the
/// term is s s^T v = s t with s = sqrt(stiffness) n. Of several contacts a particle heeds the one
/// that it violates most. What is left of the depth, and friction, are the collider's.
class ContactTerms {
 public:
  explicit ContactTerms(int size);

  /// Chooses the contacts that hold. @param start  positions at the start of the step
  void choose(std::span<const Contact> contacts, const Planes3& start, const Planes3& proposed,
              double time_step);
  /// Forgets all contacts.
  void clear();
  [[nodiscard]] bool empty() const { return active_ == 0; }

  /// Moves every class's contact to its representative and scales it by the diagonal blocks there.
  void scale(const Cloth& cloth, const Blocks& diagonal);
  [[nodiscard]] const Planes3& axis() const { return axis_; }          ///< s [sqrt(kg)]
  [[nodiscard]] const Grid<float>& target() const { return target_; }  ///< t [sqrt(kg) m/s]

 private:
  Planes3 axis_;
  Grid<float> target_, depth_;
  int active_ = 0;
};

}  // namespace weft
