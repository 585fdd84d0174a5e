#pragma once

#include <vector>

#include "weft/cloth/baselines/coarse_levels.h"
#include "weft/cloth/baselines/contact_terms.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/bending.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// How a solve ended.
struct SolveReport {
  int iterations = 0;
  double correction = 0;  ///< largest change of a velocity in the last iteration [m/s]
};

/// Modified conjugate gradients [baraff98] for (M + S + bending + contacts) v = b on planes,
/// preconditioned by the inverses of the 3 x 3 diagonal blocks. Particles without inverse mass keep
/// their v. Vectors are single precision, sums double in a fixed order, so every team gives the
/// same bits.
class ConjugateGradients {
 public:
  ConjugateGradients(const Cloth& cloth, InstructionSet instructions);

  struct System {
    const SpringMatrix& springs;
    ContactTerms& contacts;
    const Blocks& diagonal;  ///< of M + S + bending, summed over mates
    BendingPass& bending;
    float squared_step = 0;  ///< h^2, the factor of bending [s^2]
  };
  struct Stop {
    int max_iterations = 0;
    double correction = 0;  ///< [m/s]
  };
  /// @param rhs  [n x n] b, each sample's own part; overwritten
  /// @param v  [n x n] the guess, then the solution; mates equal [m/s]
  SolveReport solve(const System& system, const Stop& stop, Planes3& rhs, Planes3& v,
                    ThreadTeam& team);
  /// The last search direction. [n x n]
  [[nodiscard]] const Planes3& direction() const { return direction_; }

 private:
  void invert_row(const System& system, int row);
  void apply_row(const System& system, const Planes3& in, Planes3& out, int row) const;
  double precondition(const Planes3& r, Worker& worker);
  void precondition_row(const Planes3& r, int row);
  void step_row(double alpha, Planes3& r, Planes3& v, int row);
  void update_direction_row(double beta, int row);
  [[nodiscard]] double largest_step() const;
  void start(const System& system, Planes3& r, const Planes3& v, Worker& worker);
  SolveReport iterate(const System& system, const Stop& stop, Planes3& r, Planes3& v,
                      Worker& worker);

  void restore_momentum(const Planes3& r, Planes3& v, Worker& worker);

  const Cloth& cloth_;
  const KernelTable& table_;
  const ImplicitKernels& kernels_;
  double total_mass_ = 0;  ///< [kg]
  Grid<float> own_mass_;   ///< the particle's mass on its representative, else 0
  Blocks inverse_;
  CoarseLevels coarse_;
  Planes3 direction_, image_, preconditioned_;
  RowSums sums_;
  std::vector<float> squared_steps_;  ///< [n] largest |direction|^2 of each row
};

}  // namespace weft
