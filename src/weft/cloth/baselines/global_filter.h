#pragma once

#include <vector>

#include "weft/cloth/baselines/vectors3.h"
#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/filtering_kernels.h"
#include "weft/core/thread_team.h"

namespace weft {

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
  /// Between the values at every stride-th column.
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
