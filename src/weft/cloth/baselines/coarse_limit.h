#pragma once

#include <memory>
#include <vector>

#include "weft/cloth/baselines/strain_limit.h"
#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Provot's strain limit on the coarse levels of the image's mip pyramid, to be called before
/// limit_strain. A pass over single springs carries a correction by one spring, so the excess
/// length of a hanging cloth needs as many passes as it has samples a side, or these levels
/// [mueller08]. Coarse samples are joined by a row or column of springs, as printed by a diagonal
/// too: the sum of their rest lengths times 1 + e bounds the distance. There is no lower bound, as
/// folds in between only shorten it. Velocities change as in limit_strain. Corrections go by the
/// masses that bilinear weights gather, and are interpolated bilinearly, so momentum is kept. Sizes
/// are halved as far as possible; where mates no longer match, coarser levels are cut along the
/// seam, and their corrections are averaged over the mates.
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
    Cloth cloth;        ///< only the members that a limiter needs
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
