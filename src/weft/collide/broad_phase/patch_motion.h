#pragma once

#include <vector>

#include "weft/collide/broad_phase/patch_versions.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"

namespace weft {

/// How far the patches of a surface, nodes of 4 x 4 cells, are from where each was renewed last:
/// the same patch may be renewed often while others rest.
class PatchMotion {
 public:
  static constexpr int side = PatchVersions::side;

  explicit PatchMotion(int cells);
  /// Measures a step's motion. To be called by every worker; ends with a barrier.
  void measure(const MovingSurface& now, Worker& worker);
  /// Takes the measured motion of patches that are farther than `limit` as their new places; of all
  /// patches where nearly all are.
  /// @param version  that they get; larger than all before
  void renew(const MovingSurface& now, float limit, int version);

  /// The next renewal is one of all patches.
  void forget();

  /// Upper bound of the displacement of a patch's samples, at the start and at the end. [m]
  [[nodiscard]] float distance(int patch) const { return distances_[patch]; }
  /// Versions of the renewals.
  [[nodiscard]] const PatchVersions& versions() const { return versions_; }

 private:
  [[nodiscard]] int blocks() const { return (size_ + side - 1) / side; }
  void measure_blocks(const MovingSurface& now, int row);
  void join_distances(int row);
  void renew_all(const MovingSurface& now, int version);
  void renew_block(const MovingSurface& now, int row, int col);

  int size_, patches_;            // samples and patches a side
  Planes3 start_, end_;           // of the last renewal, by blocks of 4 x 4 samples
  bool known_ = false;            // whether there was one
  Grid<float> squared_;           // per block row: of its samples, the largest [m^2]
  std::vector<float> blocks_;     // [blocks x blocks] distances [m]
  std::vector<float> distances_;  // [patches x patches] [m]
  PatchVersions versions_;
};

}  // namespace weft
