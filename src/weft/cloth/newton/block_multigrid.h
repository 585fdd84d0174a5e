#pragma once

#include <vector>

#include "weft/cloth/newton/bending_stencil.h"
#include "weft/cloth/newton/block_level.h"
#include "weft/cloth/newton/coarsest_solver.h"
#include "weft/cloth/newton/contact_product.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/cloth/newton/seam_lines.h"
#include "weft/cloth/newton/spring_hessian.h"
#include "weft/core/ordered_sum.h"

namespace weft {

/// A V-cycle that preconditions the step's linear system A = M / h^2 + springs + bending +
/// contacts. Cloth is stiff along its threads and soft across them, so point relaxation converges
/// slowly. The convergence of line relaxation, along rows and along columns, does not depend on how
/// stiff the threads are [trottenberg01, section 5.1]. Coarse levels are Galerkin products of 3 x 3
/// blocks. A cycle relaxes rows, applies the coarse correction and relaxes columns. This is not
/// symmetric, so the conjugate gradients that it preconditions make each direction conjugate to the
/// last one by its product.
class BlockMultigrid {
 public:
  /// @param cloth  kept by reference  @param workers  size of the calling team
  BlockMultigrid(const Cloth& cloth, int workers, const NewtonKernels& kernels);

  // To be called by every worker; each ends with a barrier.

  /// Fills the diagonal blocks of a row of the finest level, before set_up; no barrier.
  void fill_diagonals(const SpringHessian& springs, int row);
  /// Adds blocks to the diagonal blocks of a sample of the finest level.
  void add_to_diagonals(const ContactProduct::Blocks& blocks, int row, int col);
  /// Sets up all levels for linearised springs, whose diagonal blocks are filled already.
  void set_up(SpringHessian& springs, Worker& worker);
  /// The contacts' part of a product as loads on the samples of this cloth.
  struct Loads {
    const ContactProduct* product = nullptr;  ///< null: none
    std::size_t cloth = 0;                    ///< the index of this one
  };
  /// One V-cycle from zero: value() approximates A^-1 rhs().
  void cycle(Worker& worker);
  /// The same in three parts, with contacts: for the second and third, loads are those of value().
  void smooth_first(Worker& worker);
  void correct(const Loads& contacts, Worker& worker);
  void smooth_last(const Loads& contacts, Worker& worker);
  /// Terms of the exact operator beside springs, flat bending and its border; null: none.
  struct ExactParts {
    Loads contacts{};
    CurvedBending* curved = nullptr;  ///< instead of flat bending
    double* row_products = nullptr;   ///< [n] receives each row's part of x . A x
  };
  /// out = A x on the finest level, seam copies equal, 0 where pinned.
  void apply(const PaddedVectors& x, const ExactParts& parts, PaddedVectors& out, Worker& worker);
  /// Adds the loads of contacts, summed over seam copies, to a field; 0 where pinned.
  void add_loads(const Loads& contacts, PaddedVectors& field, Worker& worker);
  /// Sums the diagonal blocks of the finest level, as they were filled, over seam copies; they are
  /// to be filled again before set_up.
  const PlaneSet& join_diagonals(Worker& worker);

  /// Linearises springs and computes the forces of inertia, springs and bending, seam copies equal,
  /// 0 where pinned. @param curved  instead of flat bending, at the same positions; null: none
  void linearise(const SpringHessian::Point& point, CurvedBending* curved, SpringHessian& springs,
                 PaddedVectors& force, Worker& worker);
  /// Energy of flat bending at positions; all workers get it [J].
  double bending_energy(const PaddedVectors& position, RowSums& sums, const PaddedPlane& share,
                        Worker& worker);
  void clear_pins(PaddedVectors& field, Worker& worker) const {
    clear_pins(field, Workers(worker, false));
    worker.barrier();
  }
  /// Sums own parts over seam copies and clears pins.
  void complete(PaddedVectors& field, Worker& worker) const {
    complete(0, field, Workers(worker, false));
  }

  /// Updates the pins, after particles may have been pinned or released. @return whether any was
  bool renew_pins();

  /// [n x n] seam copies equal [N]
  [[nodiscard]] PaddedVectors& rhs() { return levels_.front().rhs; }
  [[nodiscard]] const PaddedVectors& value() const { return levels_.front().value; }
  [[nodiscard]] const BlockLevel& finest() const { return levels_.front(); }
  [[nodiscard]] const Seams& seams() const { return levels_.front().seams; }
  [[nodiscard]] const PaddedPlane& mask() const { return mask_; }

 private:
  enum class Direction { rows, cols };
  /// Computes u of flat bending, summed over seam copies.
  void bend(BlockLevel& level, const PaddedVectors& x, const Workers& workers);
  /// Adds factor M^T M x to a worker's rows in turn: before(row) fills the row, after(row) gets it
  /// complete.
  struct Bent {
    const PaddedVectors& x;
    float factor = 1;
  };
  template <class Before, class After>
  void add_bending(BlockLevel& level, const Bent& bent, PaddedVectors& out, const Workers& workers,
                   const Before& before, const After& after);
  static void add_load_row(const Loads& contacts, int row, float factor, PaddedVectors& out);
  /// Decides which levels' products include bending.
  void choose_bending(double time_step);
  void find_bending_rates();
  static void set_pins(BlockLevel& level, const std::vector<bool>& pinned);
  static void hold_pins(BlockLevel& level, bool held);
  void stencil_residual_row(BlockLevel& level, int row, RowSweep& sweep) const;
  [[nodiscard]] bool pins_changed() const;
  void clear_pinned_blocks(int row);
  static void clear_pins_of_row(const BlockLevel& level, int row, PaddedVectors& field);
  /// Sums over seam copies and clears pins.
  void complete(std::size_t index, PaddedVectors& out, const Workers& workers) const;
  void residual(std::size_t index, const Loads& contacts, const Workers& workers);
  void smooth_from_zero(std::size_t index, Direction direction, const Workers& workers);
  void smooth(std::size_t index, Direction direction, const Loads& contacts,
              const Workers& workers);
  void relax(BlockLevel& level, Direction direction, bool from_zero, const Workers& workers);
  void solve_lines(const LineFactor& lines, const PaddedVectors& rhs, LineFactor::Solve how,
                   PaddedVectors& out, const Workers& workers);
  void restrict_residual(BlockLevel& fine, BlockLevel& coarse, const Workers& workers);
  /// The coarse values are of no use afterwards.
  void prolong(BlockLevel& coarse, std::size_t fine_index, const Workers& workers);
  void cycle(std::size_t index, const Workers& workers);
  void correct(std::size_t index, const Loads& contacts, const Workers& workers);
  void cycle_coarsest(std::size_t index, const Workers& workers);
  void factor(std::size_t index, const Workers& workers);
  void join_edges(std::size_t index);
  void join_springs(const std::vector<BorderEdge>& group);
  void part_edges(std::size_t index);
  void join_seams(std::size_t index, const Workers& workers);
  void part_seams(std::size_t index, const Workers& workers);
  void clear_pins(PaddedVectors& field, const Workers& workers) const;
  void add_border_row(const PaddedVectors& x, int row, float factor, PaddedVectors& out) const;
  void find_border_springs();
  void stiffen_border(int row, SpringHessian& springs) const;
  [[nodiscard]] float* scratch(const Workers& workers);

  const Cloth& cloth_;
  const NewtonKernels* kernels_;
  SpringHessian* springs_ = nullptr;
  std::vector<BlockLevel> levels_;
  CoarsestSolver coarsest_;
  Galerkin galerkin_;
  SeamLines joined_lines_, apart_lines_;  // the latter while seams are being sewn
  PaddedPlane mask_;                      // 1 where the particle moves
  std::vector<PaddedPlane> scratch_;
  std::vector<RowSweep> sweeps_;  // of each worker
  /// The free-border edges of bending are like springs to near neighbours without a direction: on a
  /// sheet without seams they are added to those.
  struct BorderStiffness {
    int plane = 0, col = 0;  // of a spring's t
    float value = 0;
  };
  std::vector<BorderStiffness> border_;
  std::vector<int> border_starts_;  // [n + 1] first of each row; empty: none
  // While seams are joined, own blocks of border edges, and of centres:
  std::vector<float> parted_, parted_centres_;
};

}  // namespace weft
