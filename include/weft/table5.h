#pragma once

#include <optional>
#include <span>
#include <vector>

#include "weft/progress.h"
#include "weft/threads.h"

namespace weft {

/// One row of the paper's Figure 5 as printed [zink07]: seconds on a 2.0 GHz laptop of 2007.
struct Figure5Row {
  int n = 0;                            ///< samples a side
  int global_size = 0, local_size = 0;  ///< n_g, n_l
  std::optional<double> global_matrix;  ///< to make W_g; none: filled with arbitrary values
  double local_matrix = 0;              ///< to make W_l
  double integration = 0;               ///< of a frame by two_level
  std::optional<double> dense_matrix;   ///< to make Desbrun's W, of the cloth
  double dense_integration = 0;         ///< of a frame with it; at n = 81 probably swapping
};
/// All 19, in the paper's order.
std::span<const Figure5Row> figure5();

/// A row measured here [s]; the errors are in metres, none unless asked for.
struct Table5Row {
  Figure5Row paper;
  int particles = 0;
  double stiffness = 0;  ///< of every spring, k [N/m]
  double global_matrix = 0, local_matrix = 0, dense_matrix = 0;
  double two_level = 0, desbrun = 0, multigrid = 0;  ///< mean time of a whole step
  std::optional<double> two_level_error{}, desbrun_error{}, multigrid_error{};
};

struct Table5Options {
  std::span<const Figure5Row> rows = figure5();
  int frames = 60;
  int rounds = 3;       ///< runs of each method; the smallest mean counts, as other load only adds
  bool errors = false;  ///< RMS distance after all frames to a converged implicit solution
  TeamOptions team = 1;
  Progress* progress = nullptr;
};

/// Runs the paper's comparison: a sheet of 1 m and 0.2 kg, slightly wavy, falls freely; a step a
/// frame of 1/60 s, no collision, ten passes of the strain limiter at 5 %. All springs have k such
/// that h^2 k / m = 0.1 inside the sheet, at which two_level is stable with n_l = 5; the soft
/// springs of its filter have the same k.
std::vector<Table5Row> measure_table5(const Table5Options& options);

/// Multigrid alone on the same cloth, at any size. @return mean time of a whole step [s]
double measure_multigrid(int n, const Table5Options& options);

}  // namespace weft
