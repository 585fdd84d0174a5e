#include "weft/cloth/newton/block_multigrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

BlockStencilRow stencil_row(const BlockStencil& s, int r) {
  return {row_of(s.centre, r),
          row_of(s.right, r),
          row_of(s.below_left, r),
          row_of(s.below, r),
          row_of(s.below_right, r),
          row_of(s.right, r, -1),
          row_of(s.below_left, r - 1, 1),
          row_of(s.below, r - 1),
          row_of(s.below_right, r - 1, -1)};
}

std::vector<BlockLevel> make_levels(const Cloth& cloth, int workers) {
  std::vector<BlockLevel> levels;
  LevelLayout layout(cloth.mates);
  levels.emplace_back(BlockLevel::Shape{layout, true, workers}, Seams(cloth.mates, layout),
                      BendingStencil(cloth.bending));
  // Many charts are coarsened further, to fewer unknowns of the direct solver.
  const int least = layout.charts.size() > 1 ? 2 : CoarsestSolver::max_size;
  while (layout.largest_side() > least) {
    const BlockLevel& fine = levels.back();
    LevelLayout coarse = layout.coarsened();
    levels.emplace_back(BlockLevel::Shape{coarse, false, workers},
                        fine.seams.coarsened(layout, coarse),
                        fine.bending.coarsened(layout, coarse));
    layout = std::move(coarse);
  }
  return levels;
}

}  // namespace

BlockMultigrid::BlockMultigrid(const Cloth& cloth, int workers, const NewtonKernels& kernels)
    : cloth_(cloth),
      kernels_(&kernels),
      levels_(make_levels(cloth, workers)),
      coarsest_(levels_.size() > 1 ? CoarsestSolver(levels_.back()) : CoarsestSolver()),
      galerkin_(cloth.size, workers),
      mask_(cloth.size, cloth.size),
      free_extra_(cloth.size, cloth.size) {
  // Second-neighbour springs are not in the stencil: the smoother adds a bound of them.
  const auto far_stiffness = static_cast<float>(8 * cloth.material.bend_springs);
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      // Nor are the free-border edges of bending, which at corners more than double the diagonal.
      const float bordered =
          cloth.bending.active ? bending_share * cloth.bending.diagonal(r, c) : 0.0F;
      const float bending = std::max(levels_.front().extra(r, c), bordered);
      free_extra_(r, c) = bending + far_stiffness;
    }
  for (int i = 0; i < workers; ++i) sweeps_.emplace_back(SpringHessian::sweep_rows, cloth.size);
  for (int i = 0; i < workers; ++i)
    scratch_.emplace_back(
        std::max(LineFactor::scratch_size(cloth.size), std::size_t(cloth.size) + 64));
  parted_.reserve(static_cast<std::size_t>(4) * cloth.size * 6);
  renew_pins();
}

bool BlockMultigrid::pins_changed() const {
  const int n = cloth_.size;
  int changed = 0;
  for (int r = 0; r < n; ++r) {
    const float *free = mask_.row(r), *inverse_mass = cloth_.inverse_mass.row(r);
    for (int c = 0; c < n; ++c)
      changed |= static_cast<int>(inverse_mass[c] > 0) ^ static_cast<int>(free[c] > 0);
  }
  return changed != 0;
}

bool BlockMultigrid::renew_pins() {
  if (!pin_starts_.empty() && !pins_changed()) return false;
  const int n = cloth_.size;
  PaddedPlane& extra = levels_.front().extra;
  pinned_.clear();
  pin_starts_.assign(static_cast<std::size_t>(n) + 1, 0);
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) {
      const bool moves = cloth_.inverse_mass(r, c) > 0;
      mask_(r, c) = moves ? 1.0F : 0.0F;
      extra(r, c) = moves ? free_extra_(r, c) : holding_stiffness;
      if (!moves) pinned_.push_back(r * n + c);
    }
    pin_starts_[r + 1] = static_cast<int>(pinned_.size());
  }
  return true;
}

std::span<float> BlockMultigrid::scratch(const Workers& workers) {
  return scratch_[workers.rank()];
}

void BlockMultigrid::clear_pins(PaddedVectors& field, const Workers& workers) const {
  const Range mine = workers.share(static_cast<int>(pinned_.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const int r = pinned_[i] / cloth_.size, c = pinned_[i] % cloth_.size;
    field.x(r, c) = field.y(r, c) = field.z(r, c) = 0;
  }
}

void BlockMultigrid::clear_pins_of_row(int row, PaddedVectors& field) const {
  for (int i = pin_starts_[row]; i < pin_starts_[row + 1]; ++i) {
    const int c = pinned_[i] % cloth_.size;
    field.x(row, c) = field.y(row, c) = field.z(row, c) = 0;
  }
}

void BlockMultigrid::bend(BlockLevel& level, const PaddedVectors& x, const Workers& workers) {
  const Range mine = workers.share(level.size);
  for (int r = mine.first; r < mine.last; ++r)
    level.bending.bend_row(x, r, *kernels_, level.curved.row(r));
  workers.barrier();
  if (level.seams.empty()) return;
  level.seams.sum(workers, {&level.curved.x, &level.curved.y, &level.curved.z});
  workers.barrier();
}

template <class Before, class After>
void BlockMultigrid::add_bending(BlockLevel& level, const PaddedVectors& x, PaddedVectors& out,
                                 const Workers& workers, const Before& before, const After& after) {
  const Range mine = workers.share(level.size);
  const BendingStencil& bending = level.bending;
  // With seams, u is summed over copies before M^T is applied; else three rows of it at a time are
  // enough.
  const bool whole = bending.active() && !level.seams.empty();
  if (whole) bend(level, x, workers);
  PaddedVectors& window = level.windows[workers.rank()];
  const auto slot = [](int r) { return (r + 3) % 3; };
  const auto make = [&](int r) { bending.bend_row(x, r, *kernels_, window.row(slot(r))); };
  for (int r = mine.first; r < mine.last; ++r) {
    before(r);
    if (whole) {
      bending.unbend_row(rows_around(level.curved, r), r, *kernels_, out.row(r));
    } else if (bending.active()) {
      for (int next = r == mine.first ? r - 1 : r + 1; next <= r + 1; ++next) make(next);
      const PaddedVectors& u = window;
      bending.unbend_row({u.row(slot(r - 1)), u.row(slot(r)), u.row(slot(r + 1))}, r, *kernels_,
                         out.row(r));
    }
    after(r);
  }
}

void BlockMultigrid::add_border_row(const PaddedVectors& x, int row, PaddedVectors& out) const {
  const BorderBending& border = cloth_.bending.border;
  if (border.starts.empty()) return;
  for (int i = border.starts[row]; i < border.starts[row + 1]; ++i) {
    const BorderBending::Edge& edge = border.edges[i];
    const int c = edge.col, r2 = edge.other_row, c2 = edge.other_col;
    out.x(row, c) += edge.stiffness * (x.x(row, c) - x.x(r2, c2));
    out.y(row, c) += edge.stiffness * (x.y(row, c) - x.y(r2, c2));
    out.z(row, c) += edge.stiffness * (x.z(row, c) - x.z(r2, c2));
  }
}

void BlockMultigrid::add_contact_row(const PaddedVectors& x, int row, PaddedVectors& out) const {
  if (contacts_.touched == nullptr || contacts_.touched[row] == 0) return;
  kernels_->add_blocks(whole_vectors(cloth_.size), row_of(*contacts_.blocks, row), x.row(row),
                       out.row(row));
}

void BlockMultigrid::complete(std::size_t index, PaddedVectors& out, const Workers& workers) const {
  workers.barrier();
  const BlockLevel& level = levels_[index];
  if (!level.seams.empty()) {
    level.seams.sum(workers, {&out.x, &out.y, &out.z});
    workers.barrier();
  }
  if (index > 0 || pinned_.empty()) return;
  clear_pins(out, workers);
  workers.barrier();
}

void BlockMultigrid::apply(const PaddedVectors& x, const ExactParts& parts, PaddedVectors& out,
                           Worker& worker) {
  const Workers all(worker, false);
  BlockLevel& level = levels_.front();
  SpringHessian::Sweep sweep{x, sweeps_[worker.rank()]};
  const auto finish = [&](int r) {
    if (parts.contacts != nullptr && parts.contacts->row(r))
      parts.contacts->add_row(r, parts.loads, out.row(r));
    // Taken before the sum over seam copies: each copy adds its own part.
    if (parts.row_products != nullptr)
      parts.row_products[r] =
          kernels_->dot(whole_vectors(level.size), nullptr, x.row(r), std::as_const(out).row(r));
    if (level.seams.empty()) clear_pins_of_row(r, out);
  };
  if (parts.curved != nullptr) {
    parts.curved->change(x, worker);
    const Range mine = all.share(level.size);
    for (int r = mine.first; r < mine.last; ++r) {
      springs_->apply_row(sweep, r, out);
      parts.curved->add_row(r, out);
      finish(r);
    }
  } else {
    const auto begin = [&](int r) {
      springs_->apply_row(sweep, r, out);
      add_border_row(x, r, out);
    };
    add_bending(level, x, out, all, begin, finish);
  }
  if (level.seams.empty()) return worker.barrier();
  complete(0, out, all);
}

void BlockMultigrid::add_loads(const ContactGather& contacts, std::span<const Vec3f> loads,
                               float factor, PaddedVectors& field, Worker& worker) {
  const Workers all(worker, false);
  BlockLevel& level = levels_.front();
  PaddedVectors& sum = level.curved;
  const Range mine = all.share(level.size);
  for (int r = mine.first; r < mine.last; ++r) {
    kernels_->scale_rows(whole_vectors(level.size), 0, sum.row(r));
    contacts.add_row(r, loads, sum.row(r));
  }
  complete(0, sum, all);
  for (int r = mine.first; r < mine.last; ++r)
    kernels_->add_scaled(whole_vectors(level.size), factor, std::as_const(sum).row(r),
                         field.row(r));
  worker.barrier();
}

void BlockMultigrid::add_bending_gradient(const PaddedVectors& position, PaddedVectors& gradient,
                                          Worker& worker) {
  add_bending(
      levels_.front(), position, gradient, Workers(worker, false),
      [&](int r) { add_border_row(position, r, gradient); }, [](int) {});
  worker.barrier();
}

double BlockMultigrid::bending_energy(const PaddedVectors& position, RowSums& sums,
                                      const PaddedPlane& share, Worker& worker) {
  const BlockLevel& level = levels_.front();
  if (!level.bending.active()) return 0;
  bend(levels_.front(), position, Workers(worker, false));
  const BorderBending& border = cloth_.bending.border;
  return sums.sum(worker, [&](int r) {
    const ConstRow3 u = level.curved.row(r);
    double energy = 0.5 * kernels_->dot(whole_vectors(level.size), share.row(r), u, u);
    if (border.starts.empty()) return energy;
    for (int i = border.starts[r]; i < border.starts[r + 1]; ++i) {
      const BorderBending::Edge& edge = border.edges[i];
      const Vec3f displacement{
          position.x(edge.other_row, edge.other_col) - position.x(r, edge.col),
          position.y(edge.other_row, edge.other_col) - position.y(r, edge.col),
          position.z(edge.other_row, edge.other_col) - position.z(r, edge.col)};
      // Each edge is stored at both of its ends.
      energy += 0.25 * edge.stiffness * squared_length(vec_cast<double>(displacement));
    }
    return energy;
  });
}

void BlockMultigrid::residual(std::size_t index, const Workers& workers) {
  BlockLevel& level = levels_[index];
  const bool seamed = !level.seams.empty();
  SpringHessian::Sweep sweep{level.value, sweeps_[workers.rank()]};
  const auto begin = [&](int r) {
    if (index == 0)
      springs_->apply_row(sweep, r, level.residual);
    else
      kernels_->apply_blocks(whole_vectors(level.size), stencil_row(level.stencil, r),
                             rows_around(level.value, r), level.residual.row(r));
  };
  const auto subtract = [&](int r) {
    kernels_->subtract(whole_vectors(level.size), std::as_const(level.rhs).row(r),
                       std::as_const(level.residual).row(r), level.residual.row(r));
    if (index == 0) clear_pins_of_row(r, level.residual);
  };
  add_bending(level, level.value, level.residual, workers, begin, [&](int r) {
    if (index == 0) add_contact_row(level.value, r, level.residual);
    if (!seamed) subtract(r);
  });
  workers.barrier();
  if (!seamed) return;
  level.seams.sum(workers, {&level.residual.x, &level.residual.y, &level.residual.z});
  workers.barrier();
  const Range mine = workers.share(level.size);
  for (int r = mine.first; r < mine.last; ++r) subtract(r);
  workers.barrier();
}

}  // namespace weft
