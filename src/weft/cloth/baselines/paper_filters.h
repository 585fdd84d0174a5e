#pragma once

#include <vector>

#include "weft/cloth/baselines/filter_matrix.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/filtering_kernels.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"

namespace weft {

/// The paper's local filter: W_l of an n_l x n_l patch of equal particles, laid over the image with
/// its centre on each sample in turn, or with its side along the border where it would reach beyond
/// [zink07, section 4]. Each sample takes the row of W_l that belongs to its place in the patch.
///
/// The patch and the rows of W_l are mirror-symmetric: for samples whose patch is centred, values
/// at equal distances left and right, above and below, are added before they are weighted.
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

/// The paper's global filter: W_g of the n_g x n_g samples at every (n - 1) / (n_g - 1)-th row and
/// column, mates merged, its result interpolated bilinearly to all samples [zink07, section 4]. A
/// coarse particle has the mass of the samples around it by their bilinear weights, so that its
/// springs, as stiff as the fine ones, filter smooth fields as the exact W of the whole cloth
/// would.
class GlobalFilter {
 public:
  struct Options {
    int size = 0;            ///< n_g, n - 1 a multiple of n_g - 1
    double stiffness = 0;    ///< of springs between mean particles [N/m]
    double time_step = 0;    ///< [s]
    bool difference = true;  ///< interpolate W_g a - a, not W_g a
  };
  GlobalFilter(const Cloth& cloth, const Options& options, ThreadTeam& team);

  /// Computes this worker's share of W_g a at the coarse samples. To be called by every worker;
  /// barriers before and after are the caller's.
  void filter(const Planes3& in, Worker& worker);
  /// Adds the interpolated result to a row.
  void add_row(Planes3& out, int row) const;

  [[nodiscard]] const Grid<float>& matrix() const { return matrix_; }
  [[nodiscard]] const std::vector<double>& masses() const { return masses_; }

 private:
  /// Interpolates linearly between the values at every stride-th column.
  void interpolate_row(float* row) const;

  int size_, coarse_, stride_;
  bool difference_;
  const FilteringKernels& kernels_;
  std::vector<int> particle_of_;  ///< [n_g^2]
  std::vector<int> sample_of_;    ///< [particles] fine sample of each
  std::vector<double> masses_;    ///< [particles]
  Grid<float> matrix_;            ///< [particles x particles]
  Vectors3 sampled_, filtered_;   ///< [particles] before and after
  /// [n_g x n] the result, interpolated along rows
  struct {
    Grid<float> x, y, z;
  } along_;
};

}  // namespace weft
