#pragma once

#include <span>
#include <vector>

#include "weft/garment.h"

namespace weft {

/// How much longer the cloth beside a garment's seams is than at rest, as a part, and by how much
/// panels can be pulled on without stretching them too far.
class SeamStretch {
 public:
  /// Finds the slack.
  /// @param garment  kept by reference  @param start  where its panels begin [n x n] [m]
  SeamStretch(const Garment& garment, const Planes3& start);

  /// Of each seam the mean over its classes of sewn samples of their largest stretch towards
  /// neighbours in their panels.
  /// @param seams  the classes along each
  [[nodiscard]] std::vector<double> along(std::span<const std::vector<int>> seams,
                                          const Planes3& position) const;
  /// Finds how far panels can be pulled on. Allocates nothing.
  void find_slack(const Planes3& position);
  /// The part of its speed with which a class is pulled late, from 0 to 1, as its panels allow.
  [[nodiscard]] double slack_of(int index) const;

 private:
  /// The largest stretch from the samples of a class to their neighbours.
  [[nodiscard]] double of_class(int index, const Planes3& position) const;

  const Garment& garment_;
  std::vector<std::vector<double>> stretches_;  // of each panel, at its seams
  std::vector<double> slack_;                   // of each panel
};

}  // namespace weft
