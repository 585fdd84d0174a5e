#pragma once

#include <array>
#include <cstddef>

#include "weft/simulation.h"

namespace weft::viewer {

/// Plot of the costs of the last frames, stacked by stage.
class StagePlot {
 public:
  /// Adds a frame; the last number again is ignored, a smaller one clears the plot.
  void add(int frame, const FrameReport& report);
  void clear() { count_ = 0; }
  /// Draws the plot at the panel's current position, with its key. @param height  [pixels]
  void show(float height) const;

 private:
  static constexpr std::size_t stages = 4, kept = 120;
  using Costs = std::array<float, stages>;  // [ms]
  [[nodiscard]] const Costs& at(std::size_t i) const {
    return costs_[(next_ + kept - count_ + i) % kept];
  }
  [[nodiscard]] float largest() const;
  [[nodiscard]] Costs usual() const;

  std::array<Costs, kept> costs_{};
  std::size_t next_ = 0, count_ = 0;
  int last_frame_ = -1;
};

}  // namespace weft::viewer
