#pragma once

#include <vector>

#include "weft/cloth/kernels/filtering_kernels.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"

namespace weft {

/// The paper's local filter: W_l of an n_l x n_l patch of equal particles, laid over the image with
/// its centre on each sample in turn, or with its side along the border where it would reach beyond
/// [zink07, section 4]. Each sample takes the row of W_l that belongs to its place in the patch.
///
/// The patch is its own mirror image, and so are the rows of W_l: samples whose patch is centred
/// add what lies at equal distances left and right, above and below, before they weigh it.
class LocalFilter {
 public:
  /// @param image_size  n, >= patch_size
  /// @param patch_size  n_l, odd, up to `largest_patch`
  /// @param ratio       h^2 k / m of the patch
  LocalFilter(int image_size, int patch_size, double ratio, ThreadTeam& team);
  static constexpr int largest_patch = 65;

  /// Filters row `row`; reads the rows around it.
  void apply_row(const Planes3& in, Planes3& out, int row, const Worker& worker);

 private:
  void apply_plane_row(const Grid<float>& in, Grid<float>& out, int row, const Worker& worker);
  [[nodiscard]] PatchWeights weights(int patch_row) const;

  int size_, patch_, half_, lanes_;
  const FilteringKernels& kernels_;
  /// [n_l places x n_l rows x (n_l / 2 + 1) distances] of samples in the middle column
  std::vector<float> centred_;
  /// [n_l places x n_l rows x n_l columns x lanes] of the first n_l / 2 columns, padded with zeros
  std::vector<float> beside_;
  Grid<float> lines_;  ///< [2 (n_l / 2 + 1) a worker x n] scratch
};

}  // namespace weft
