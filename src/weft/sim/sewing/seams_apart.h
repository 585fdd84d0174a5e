#pragma once

#include <span>
#include <vector>

#include "weft/contact.h"
#include "weft/garment.h"

namespace weft {

/// Contacts that keep seams from passing each other while a garment is sewn. Nothing is between the
/// edges of a seam yet, and another seam that comes towards it may come to lie there, as those of
/// two trouser legs that swing together: each then holds the other open.
class SeamsApart {
 public:
  /// @param garment  kept by reference
  /// @param start    where its panels begin [n x n] [m]
  SeamsApart(const Garment& garment, const Planes3& start);

  /// Finds the contacts of a step. Allocates nothing once warmed up.
  /// @param position  at its start [n x n] [m]
  /// @param way       that two samples may go towards each other in it [m]
  void find(const Planes3& position, double way);
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }

 private:
  /// Of a class, by two of its samples.
  struct Place {
    Vec3d middle;         // [m]
    Vec3d inwards;        // into its panels, unit
    bool closed = false;  // all samples of the class are in one place
  };
  void find_places(const Planes3& position);
  [[nodiscard]] bool may_pass(int a, int b) const;
  void add(int a, int b, double way);

  const Garment& garment_;
  double distance_;                     // that seams keep [m]
  std::vector<std::vector<int>> near_;  // of each class, those near it in the garment, ascending
  std::vector<Place> starts_, places_;  // of each class, where panels begin and now
  std::vector<int> order_;              // of classes of several samples, by x
  std::vector<Contact> contacts_;
};

}  // namespace weft
