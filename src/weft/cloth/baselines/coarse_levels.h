#pragma once

#include <vector>

#include "weft/cloth/baselines/contact_terms.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The coarse part of an additive multilevel preconditioner [bramble90]: the sum over the image's
/// own mip pyramid of P_l D_l^-1 P_l^T, with P_l bilinear interpolation from every 2^l-th sample
/// and D_l the 3 x 3 diagonal blocks of the level. Added to the block-Jacobi part of the finest
/// level it keeps the iterations of conjugate gradients from growing with n. Sizes are halved as
/// far as possible. Where mates no longer match, coarser levels are cut along the seam: P_l then
/// ends with the mean over the mates, and its transpose begins with shares of the residual. Without
/// any level the preconditioner is block-Jacobi alone.
class CoarseLevels {
 public:
  CoarseLevels(const Cloth& cloth, InstructionSet instructions);
  [[nodiscard]] bool empty() const { return levels_.empty(); }
  /// Whether mates may differ after add_row and must be averaged.
  [[nodiscard]] bool parts_mates() const { return finest_.cut_below; }

  // To be called by every worker; each ends with a barrier.

  /// Sets up the levels from the diagonal blocks of the finest level, summed over mates, and the
  /// contacts. Contacts act on single particles, as mass does, so a coarse hat function gets their
  /// sum over all particles that it moves: with a mean, whole patches would be pushed through the
  /// surfaces they rest on.
  void prepare(const Blocks& diagonal, const ContactTerms& contacts, Worker& worker);
  /// Computes the corrections of all levels to a residual, summed over mates.
  void solve(const Planes3& residual, Worker& worker);

  /// Adds the corrections, interpolated, to a row of the finest level; nothing where pinned.
  void add_row(Planes3& out, int row);

 private:
  struct Level {
    BorderMates mates;
    Grid<float> share;       ///< one over the number of mates where the particle moves, else 0
    Planes3 value;           ///< residual, then correction
    Grid<float> mass;        ///< the particles' masses, shared out by bilinear weights [kg]
    Blocks spring;           ///< mean of the finest level's blocks without mass [kg]
    Blocks contact;          ///< sum of the contacts' blocks by bilinear weights [kg]
    Blocks inverse;          ///< [1/kg]
    Grid<float> line;        ///< scratch: for each row a finer row, or three coarser ones
    bool cut_below = false;  ///< the next level has no mates: corrections are averaged over these
    [[nodiscard]] int size() const { return share.rows(); }
  };
  static Level make_level(const BorderMates& mates);
  void invert_row(Level& level, bool contacts, int row) const;
  void correct_row(Level& level, const Level* below, int row) const;
  void restrict_row(const Level& fine, const Planes3& in, Level& coarse, int row) const;
  void coarsen_row(const Level& fine, bool contacts, Level& coarse, int row) const;
  static void sum_level(Level& level, bool contacts, Worker& worker);
  void set_row(const Blocks& diagonal, int row);
  void add_contacts_row(const ContactTerms& contacts, int row);
  void solve_below();

  [[nodiscard]] Row3 interpolation_lines(Level& level, int row) const;

  const Cloth& cloth_;
  const KernelTable& table_;
  const ImplicitKernels& kernels_;
  Level finest_;       ///< without values and inverses
  Grid<float> share_;  ///< of the finest level, whether pinned or not
  Grid<float> moves_;  ///< finest level: 1 where not pinned
  std::vector<Level> levels_;
};

}  // namespace weft
