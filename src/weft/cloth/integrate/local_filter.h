#pragma once

#include <vector>

#include "weft/core/planes.h"

namespace weft {

/// The paper's local filter: W_l of an n_l x n_l patch of equal particles, laid over the image with
/// its centre on each sample in turn, or with its side along the border where it would reach beyond
/// [zink07, section 4]. Each sample takes the row of W_l that belongs to its place in the patch.
class LocalFilter {
 public:
  /// @param image_size  n, >= patch_size
  /// @param patch_size  n_l, odd
  /// @param ratio       h^2 k / m of the patch
  LocalFilter(int image_size, int patch_size, double ratio);

  /// Filters row `row`; reads the rows around it.
  void apply_row(const Planes3& in, Planes3& out, int row) const;

 private:
  [[nodiscard]] const float* weights(int patch_row, int patch_col) const;
  void apply_plane_row(const Grid<float>& in, Grid<float>& out, int row) const;

  int size_, patch_;
  std::vector<float> matrix_;  ///< [n_l^2 x n_l^2]
};

}  // namespace weft
