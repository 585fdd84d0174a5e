#pragma once

#include <memory>
#include <vector>

#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Provot's limit on the coarse levels of the image's mip pyramid, to be called before
/// limit_strain. Passes over single springs carry a correction one spring a pass; what a whole
/// hanging cloth is too long by needs as many passes as it has samples a side, or this [mueller08].
/// Between coarse samples runs a row or column of springs, as printed a diagonal too: their rest
/// lengths' sum times 1 + e bounds the distance, and folds in between only shorten it, so there is
/// no lower bound. Velocities change as limit_strain changes them.
/// Corrections go by the masses that bilinear weights gather, and are interpolated bilinearly, so
/// momentum is kept. Levels reach down as far as sizes halve; where mates no longer match, coarser
/// levels are cut along the seam, and what they find is averaged over the mates.
class CoarseLimit {
 public:
  /// @param cloth  kept by reference
  CoarseLimit(const Cloth& cloth, const ThreadTeam& team);

  /// @param options  passes: on each level
  /// @param state    mates equal, before and after
  void limit(const LimitOptions& options, double time_step, ClothState& state,
             ThreadTeam& team) noexcept;

 private:
  struct Level {
    Cloth cloth;        ///< as far as a limiter needs it
    ClothState state;   ///< velocity: the correction of the positions [m]
    Grid<float> moves;  ///< 1 where not pinned
    std::unique_ptr<StrainPasses> passes{};
  };
  static std::unique_ptr<Level> coarsened(const Cloth& fine);
  void sample(const ClothState& state);
  void limit_level(std::size_t index, int passes, const StrainBounds& bounds, Worker& worker);
  void interpolate_corrections(Worker& worker);
  void apply(const StrainBounds& bounds, ClothState& state, Worker& worker);

  const Cloth& cloth_;
  std::vector<std::unique_ptr<Level>> levels_;  ///< from fine to coarse
  Grid<float> moves_;                           ///< [n x n] 1 where not pinned
  Planes3 correction_;                          ///< [n x n] [m]
  SafeVelocities velocities_;
};

}  // namespace weft
