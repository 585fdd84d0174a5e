#pragma once

#include <array>
#include <cstddef>

#include "weft/simulation.h"

namespace weft::viewer {

/// What the last frames cost, stage upon stage.
class StagePlot {
 public:
  /// One more frame; a number that was there before is not counted again.
  void add(int frame, const FrameReport& report);
  void clear() { count_ = 0; }
  /// Draws it at the panel's place, with its key. @param height  [pixels]
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
