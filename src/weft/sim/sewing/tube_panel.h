#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/garment.h"
#include "weft/grid.h"

namespace weft {

/// How a panel is rolled up.
struct Tube {
  double part = 1;             ///< of a circle that it takes
  double out = 0, across = 0;  ///< how far it is moved, to its outer side and across its seam [m]
  double turn = 0;             ///< about its axis [rad]
};

/// A panel of which two edges are sewn together that are about as far apart as it is wide, as those
/// of a sleeve of one piece are. Its axes are: across the seam, along it, and its outer side.
class TubePanel {
 public:
  /// Takes the seams of a panel with itself as those of a tube that are so.
  /// @param placed  samples of all panels, kept by reference [n x n] [m]
  TubePanel(const Garment& garment, int panel, const Planes3& placed);

  [[nodiscard]] bool is_tube() const { return !seam_.empty(); }
  /// All panels, with this one rolled up: its middle line stays where it is, inner side in,
  /// narrower where it tapers. @pre is_tube, as for all others
  [[nodiscard]] Planes3 rolled(const Tube& tube) const;
  /// Whether it then has a gap all along its seam: what is wider than a circle would overlap.
  [[nodiscard]] bool has_gap(const Tube& tube) const;
  /// The turn that brings a tube nearest to the panels that it is sewn to; 0: to none.
  [[nodiscard]] double best_turn(Tube tube) const;
  /// Points on the axis of the tube, between the ends of its seam.
  [[nodiscard]] std::vector<Vec3d> axis(const Tube& tube) const;

 private:
  using Pair = std::array<int, 2>;
  [[nodiscard]] Vec3d at(int sample) const;
  void set_axes(std::span<const Pair> seam);
  [[nodiscard]] bool is_across_panel(std::span<const Pair> seam);
  void add_to_seam(std::span<const Pair> pairs);
  void fit();
  [[nodiscard]] double radius_at(double along, const Tube& tube) const;
  [[nodiscard]] double centre_at(double along) const;
  [[nodiscard]] double angle_of(int sample, const Tube& tube) const;
  [[nodiscard]] Vec3d rolled_at(int sample, const Tube& tube) const;

  const Planes3& placed_;
  std::vector<int> samples_;
  std::vector<Pair> seam_;     // pairs of its own samples that become one
  std::vector<Pair> sewn_to_;  // a sample of its own and one of another panel
  Vec3d middle_, across_, along_, out_;
  double width_ = 0;                   // between the edges, on the mean [m]
  double widening_ = 0, leaning_ = 0;  // of the width and of its middle, along the seam
  double from_ = 0, to_ = 0;           // where the seam begins and ends [m]
};

}  // namespace weft
