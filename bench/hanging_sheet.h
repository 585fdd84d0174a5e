#pragma once

#include <optional>
#include <vector>

#include "weft/simulation.h"

namespace weft::bench {

/// The first half second of the sheet that hangs by two corners: 1 m, 0.2 kg, 2000 N/m along rows,
/// columns and diagonals, second neighbours by 0.5 N/m. Later its folds are chaotic.
inline constexpr int hanging_frames = 30;
Scene hanging_sheet(int size);

/// What one way to simulate it gave.
struct HangingRun {
  std::vector<Planes3> positions;  ///< of each frame [m]
  double milliseconds = 0;         ///< median frame
  StrainSummary strain;            ///< of the last frame
  double fall = 0;                 ///< of the centre of mass in all frames [m]
};

/// Nothing when the run runs away.
std::optional<HangingRun> run_hanging(const Scene& scene, int threads);
/// By position-based dynamics, one thread.
HangingRun run_hanging_position_based(const Scene& scene);

/// Root mean square distance over all samples and frames. [m]
double distance_between(const HangingRun& a, const HangingRun& b);

}  // namespace weft::bench
