#pragma once

#include <span>
#include <vector>

#include "weft/garment.h"
#include "weft/grid.h"

namespace weft {

/// The way from a sample of an edge into its panel. @return unit
[[nodiscard]] Vec3d way_inwards(const Garment& garment, int sample, const Planes3& position);

/// Takes the seams of a garment apart again, at times, where a few samples are held apart by cloth
/// that came to lie between them, and next to these. For one frame the edges go back into their
/// panels, so that they lie beside each other again, whatever is between; then they come together
/// anew, each time in another way. It depends on the time and on positions alone, so that runs
/// resume in any frame.
class Unpicking {
 public:
  /// @param garment  kept by reference
  explicit Unpicking(const Garment& garment);

  /// Begins a frame.
  /// @param since  frames since seams should have closed; may be negative  @param length  of one
  /// [s]
  /// @return whether it is one that seams are taken apart in: `choose` is to follow
  bool begin_frame(int since, double length);
  /// Takes apart what is stuck, and its neighbours.
  /// @param along  the classes along each seam  @param stuck  of each class
  void choose(std::span<const std::vector<int>> along, std::span<const char> stuck);

  /// Whether a class is taken apart in this frame.
  [[nodiscard]] bool takes_apart(int index) const { return chosen_[index] != 0; }
  /// Whether seams close from where they are closed already in this attempt, not all at once.
  [[nodiscard]] bool closes_as_a_zip() const { return attempt_ >= 0 && attempt_ / 2 % 2 == 1; }
  /// The velocity at which an edge goes back into its panel. @return [m/s]
  [[nodiscard]] Vec3d retreat_of(int sample, const Planes3& position) const;

 private:
  const Garment& garment_;
  std::vector<char> chosen_;  // of each class
  int attempt_ = -1;          // none yet
  double frame_length_ = 0;   // [s]
};

}  // namespace weft
