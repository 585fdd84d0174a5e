#pragma once

#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/garment.h"

namespace weft {

/// How whole panels of a garment move while it is sewn. Pulled along at its edges alone, the middle
/// of a panel would lag behind, the edges would come together before it, and seams end on the wrong
/// side of a limb: so a panel takes the mean velocity of its seams. Panels that hang from shoulders
/// or waist are not let sink, as seams that slide round a body would draw them down it: a waistband
/// from the hips, and a bodice behind it from the shoulders. What is sewn to them comes to them.
class PanelMotion {
 public:
  /// @param garment  kept by reference
  /// @param start  where its panels begin [n x n] [m]
  PanelMotion(const Garment& garment, const Planes3& start);

  [[nodiscard]] int panel_of(int sample) const { return panel_of_[sample]; }
  /// What holds up the panel of a sample.
  [[nodiscard]] PanelHold hold_of(int sample) const {
    return garment_.panel_holds[panel_of_[sample]];
  }

  /// Forgets the pulls of the last step.
  void begin_step();
  /// Adds how a seam pulls one of its samples.
  /// @param led  whether the seam joins its panel to one that holds this panel up
  void add_pull(int sample, bool led, Vec3d pull);
  /// Damps velocities towards those of the pulls, or towards none once seams should have closed.
  void carry(bool closing, double time_step, Planes3& velocity) const;
  /// Gives panels that sank the velocity upwards that brings them back.
  void hold(ClothState& state);

 private:
  struct Panel {
    double start_height = 0, height = 0, rise = 0;  // of its middle [m], [m/s]
    int size = 0;                                   // how many samples it has
    Vec3d pull;                                     // the sum of those of its seams [m/s]
    int pulled = 0;
    double led = 0;  // the sum of the vertical pulls of seams to panels that hold it up [m/s]
    int led_by = 0;
    [[nodiscard]] Vec3d wanted() const;
  };
  void measure(const ClothState& state);

  const Garment& garment_;
  std::vector<int> panel_of_;  // of each sample
  std::vector<Panel> panels_;
};

}  // namespace weft
