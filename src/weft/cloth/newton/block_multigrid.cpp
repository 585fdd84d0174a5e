#include "weft/cloth/newton/block_multigrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// Bending is left out of a level's products where its largest diagonal entry is at most this part
/// of the inertia there: the smoother's diagonals have it.
constexpr double negligible_bending = 1;

/// The masses of a coarse level's samples, as restriction sums those of a finer level.
PaddedPlane coarsened(const PaddedPlane& mass, const LevelLayout& fine, const LevelLayout& coarse) {
  PaddedPlane result(coarse.size, coarse.size);
  for (std::size_t k = 0; k < fine.charts.size(); ++k) {
    const Chart &from = fine.charts[k], &to = coarse.charts[k];
    for (int r = 0; r < from.rows; ++r)
      for (int c = 0; c < from.cols; ++c) {
        const float part = 0.25F * mass(from.row + r, from.col + c);
        for (const int row : {r / 2, (r + 1) / 2})
          for (const int col : {c / 2, (c + 1) / 2}) result(to.row + row, to.col + col) += part;
      }
  }
  return result;
}

std::vector<BlockLevel> make_levels(const Cloth& cloth, int workers) {
  std::vector<BlockLevel> levels;
  const LevelLayout finest(cloth.mates);
  levels.emplace_back(BlockLevel::Shape{finest, true, workers}, Seams(cloth.mates, finest),
                      BendingStencil(cloth.bending));
  const bool has_seams = !levels.front().seams.empty();
  // Many charts are coarsened further, to fewer unknowns of the direct solver.
  const int least = finest.charts.size() > 1 ? 2 : CoarsestSolver::max_size;
  for (int depth = 1; levels.back().layout.largest_side() > least; ++depth) {
    const BlockLevel& fine = levels.back();
    const LevelLayout coarse = fine.layout.coarsened();
    BlockLevel level({coarse, false, workers},
                     Seams(find_coarse_seams(cloth.mates, finest, coarse, depth), coarse),
                     fine.bending.coarsened(fine.layout, coarse));
    if (has_seams) {
      level.short_ends = ShortEnds(fine.layout, coarse);
      level.mismatch =
          SeamMismatch(fine.mismatch, {fine.layout, fine.seams}, {coarse, level.seams});
    }
    levels.push_back(std::move(level));
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
      joined_lines_(seams(), seams().edges()),
      apart_lines_(seams(), {}),
      mask_(cloth.size, cloth.size) {
  find_bending_rates();
  PaddedPlane& extra = levels_.front().extra;
  // Second-neighbour springs are not in the stencil: the smoother adds a bound of them.
  const auto far_stiffness = static_cast<float>(8 * cloth.material.bend_springs);
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) {
      // Nor are the free-border edges of bending, which at corners more than double the diagonal.
      const float bordered =
          cloth.bending.active ? bending_share * cloth.bending.diagonal(r, c) : 0.0F;
      extra(r, c) = std::max(extra(r, c), bordered) + far_stiffness;
    }
  // The smoother has what bends a particle once, at its first copy.
  for (int i = 0; i < seams().class_count(); ++i)
    for (const int s : seams().samples(i).subspan(1)) extra(s / cloth.size, s % cloth.size) = 0;
  for (int i = 0; i < workers; ++i) sweeps_.emplace_back(cloth.size);
  for (int i = 0; i < workers; ++i)
    scratch_.emplace_back(1, static_cast<int>(LineFactor::scratch_size(cloth.size)));
  find_border_springs();
  parted_.reserve(static_cast<std::size_t>(4) * cloth.size * 6);
  for (const BlockLevel& level : levels_)
    parted_centres_.resize(std::max(
        parted_centres_.size(), static_cast<std::size_t>(level.seams.copies()) * block_entries));
  renew_pins();
}

float* BlockMultigrid::scratch(const Workers& workers) { return scratch_[workers.rank()].row(0); }

void BlockMultigrid::find_border_springs() {
  const BorderBending& border = cloth_.bending.border;
  if (border.starts.empty() || !seams().empty()) return;
  border_starts_.push_back(0);
  for (int r = 0; r < cloth_.size; ++r) {
    for (int i = border.starts[r]; i < border.starts[r + 1]; ++i) {
      const BorderBending::Edge& edge = border.edges[i];
      for (int d = 0; d < near_directions; ++d)
        if (edge.other_row == r + spring_offsets[d].down &&
            edge.other_col == edge.col + spring_offsets[d].right)
          border_.push_back({d * spring_entries, edge.col, edge.stiffness});
    }
    border_starts_.push_back(static_cast<int>(border_.size()));
  }
}

void BlockMultigrid::stiffen_border(int row, SpringHessian& springs) const {
  if (border_starts_.empty()) return;
  for (int i = border_starts_[row]; i < border_starts_[row + 1]; ++i) {
    const BorderStiffness& added = border_[i];
    springs.near()(row, added.col, added.plane) += added.value;
  }
}

void BlockMultigrid::find_bending_rates() {
  PaddedPlane mass(cloth_.size, cloth_.size);
  for (int r = 0; r < cloth_.size; ++r) std::copy_n(cloth_.mass.row(r), cloth_.size, mass.row(r));
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    BlockLevel& level = levels_[i];
    if (i > 0) mass = coarsened(mass, levels_[i - 1].layout, level.layout);
    for (int r = 0; r < level.size; ++r)
      for (int c = 0; c < level.size; ++c)
        if (level.extra(r, c) < holding_stiffness && mass(r, c) > 0)
          level.bending_rate = std::max(level.bending_rate,
                                        double{level.extra(r, c)} / (bending_share * mass(r, c)));
  }
}

void BlockMultigrid::choose_bending(double time_step) {
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    BlockLevel& level = levels_[i];
    level.bends = level.bending_rate * time_step * time_step > negligible_bending;
    if (i > 0) hold_pins(level, levels_[i - 1].bends);
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
void BlockMultigrid::add_bending(BlockLevel& level, const Bent& bent, PaddedVectors& out,
                                 const Workers& workers, const Before& before, const After& after) {
  const Range mine = workers.share(level.size);
  const BendingStencil& bending = level.bending;
  // With seams, u is summed over copies before M^T is applied; else three rows of it at a time are
  // enough.
  const bool whole = bending.active() && !level.seams.empty();
  if (whole) bend(level, bent.x, workers);
  PaddedVectors& window = level.windows[workers.rank()];
  const auto slot = [](int r) { return (r + 3) % 3; };
  const auto make = [&](int r) { bending.bend_row(bent.x, r, *kernels_, window.row(slot(r))); };
  for (int r = mine.first; r < mine.last; ++r) {
    before(r);
    if (whole) {
      bending.unbend_row(rows_around(level.curved, r), r, bent.factor, *kernels_, out.row(r));
    } else if (bending.active()) {
      for (int next = r == mine.first ? r - 1 : r + 1; next <= r + 1; ++next) make(next);
      const PaddedVectors& u = window;
      bending.unbend_row({u.row(slot(r - 1)), u.row(slot(r)), u.row(slot(r + 1))}, r, bent.factor,
                         *kernels_, out.row(r));
    }
    after(r);
  }
}

void BlockMultigrid::add_border_row(const PaddedVectors& x, int row, float factor,
                                    PaddedVectors& out) const {
  const BorderBending& border = cloth_.bending.border;
  if (border.starts.empty()) return;
  for (int i = border.starts[row]; i < border.starts[row + 1]; ++i) {
    const BorderBending::Edge& edge = border.edges[i];
    const int c = edge.col, r2 = edge.other_row, c2 = edge.other_col;
    const float stiffness = factor * edge.stiffness;
    out.x(row, c) += stiffness * (x.x(row, c) - x.x(r2, c2));
    out.y(row, c) += stiffness * (x.y(row, c) - x.y(r2, c2));
    out.z(row, c) += stiffness * (x.z(row, c) - x.z(r2, c2));
  }
}

void BlockMultigrid::add_load_row(const Loads& contacts, int row, float factor,
                                  PaddedVectors& out) {
  if (contacts.product != nullptr)
    contacts.product->add_row(contacts.cloth, row, factor, out.row(row));
}

void BlockMultigrid::complete(std::size_t index, PaddedVectors& out, const Workers& workers) const {
  workers.barrier();
  const BlockLevel& level = levels_[index];
  if (!level.seams.empty()) {
    level.seams.sum(workers, {&out.x, &out.y, &out.z});
    workers.barrier();
  }
  if (index > 0 || level.pins.empty()) return;
  clear_pins(out, workers);
  workers.barrier();
}

void BlockMultigrid::apply(const PaddedVectors& x, const ExactParts& parts, PaddedVectors& out,
                           Worker& worker) {
  const Workers all(worker, false);
  BlockLevel& level = levels_.front();
  RowSweep& sweep = sweeps_[worker.rank()];
  sweep.restart();
  const auto finish = [&](int r) {
    add_load_row(parts.contacts, r, 1, out);
    // Taken before the sum over seam copies: each copy adds its own part.
    if (parts.row_products != nullptr)
      parts.row_products[r] =
          kernels_->dot(whole_vectors(level.size), nullptr, x.row(r), std::as_const(out).row(r));
    if (level.seams.empty()) clear_pins_of_row(level, r, out);
  };
  if (parts.curved != nullptr) {
    parts.curved->change(x, worker);
    const Range mine = all.share(level.size);
    for (int r = mine.first; r < mine.last; ++r) {
      springs_->apply_row(x, r, sweep, nullptr, out);
      parts.curved->add_row(1, r, out);
      finish(r);
    }
  } else {
    const auto begin = [&](int r) {
      springs_->apply_row(x, r, sweep, nullptr, out);
      if (border_starts_.empty()) add_border_row(x, r, 1, out);
    };
    add_bending(level, {x}, out, all, begin, finish);
  }
  if (level.seams.empty()) return worker.barrier();
  complete(0, out, all);
}

void BlockMultigrid::add_loads(const Loads& contacts, PaddedVectors& field, Worker& worker) {
  const Workers all(worker, false);
  BlockLevel& level = levels_.front();
  const Range mine = all.share(level.size);
  if (level.seams.empty()) {
    for (int r = mine.first; r < mine.last; ++r) {
      add_load_row(contacts, r, 1, field);
      clear_pins_of_row(level, r, field);
    }
    return worker.barrier();
  }
  PaddedVectors& sum = level.curved;
  for (int r = mine.first; r < mine.last; ++r) {
    clear_row(sum.row(r), whole_vectors(level.size));
    add_load_row(contacts, r, 1, sum);
  }
  complete(0, sum, all);
  for (int r = mine.first; r < mine.last; ++r)
    kernels_->add_scaled(whole_vectors(level.size), 1, std::as_const(sum).row(r), field.row(r));
  worker.barrier();
}

void BlockMultigrid::linearise(const SpringHessian::Point& point, CurvedBending* curved,
                               SpringHessian& springs, PaddedVectors& force, Worker& worker) {
  const Workers all(worker, false);
  BlockLevel& level = levels_.front();
  const Range mine = all.share(level.size);
  RowSweep& sweep = sweeps_[worker.rank()];
  sweep.restart();
  const auto begin = [&](int r) {
    springs.linearise_row(point, r, sweep, force);
    stiffen_border(r, springs);
  };
  if (curved != nullptr) {
    for (int r = mine.first; r < mine.last; ++r) {
      begin(r);
      curved->add_row(-1, r, force);
    }
  } else {
    add_bending(level, {point.at.position, -1}, force, all, begin,
                [&](int r) { add_border_row(point.at.position, r, -1, force); });
  }
  if (springs.has_far()) {
    worker.barrier();
    for (int r = mine.first; r < mine.last; ++r)
      springs.add_far_forces(point.at.position, r, force);
  }
  complete(0, force, all);
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

/// A row of rhs - A value, own part, by the level's stencil.
void BlockMultigrid::stencil_residual_row(BlockLevel& level, int row, RowSweep& sweep) const {
  const PaddedVectors& x = level.value;
  const PlaneSet& stencil = level.stencil;
  const auto product = [&](int r, ConstRow3 from, Row3 to) {
    kernels_->apply_stencil(whole_vectors(level.size), rows_of(stencil, r),
                            {x.row(r), x.row(r + 1), sweep.passing(r), from}, to);
  };
  sweep.multiply(row, &level.rhs, level.residual.row(row), product);
}

/// residual = rhs - A value. With seams, products are summed over copies.
void BlockMultigrid::residual(std::size_t index, const Loads& contacts, const Workers& workers) {
  BlockLevel& level = levels_[index];
  RowSweep& sweep = sweeps_[workers.rank()];
  sweep.restart();
  const auto begin = [&](int r) {
    if (index == 0)
      springs_->apply_row(level.value, r, sweep, &level.rhs, level.residual);
    else
      stencil_residual_row(level, r, sweep);
  };
  const auto finish = [&](int r) {
    add_load_row(contacts, r, -1, level.residual);
    clear_pins_of_row(level, r, level.residual);
  };
  const Range mine = workers.share(level.size);
  if (level.bends)
    add_bending(level, {level.value, -1}, level.residual, workers, begin, finish);
  else
    for (int r = mine.first; r < mine.last; ++r) {
      begin(r);
      finish(r);
    }
  workers.barrier();
  if (level.seams.empty()) return;
  if (!level.mismatch.empty()) {
    level.mismatch.subtract(workers, level.value, level.residual);
    workers.barrier();
  }
  level.seams.sum_beside(workers, level.rhs, level.residual);
  workers.barrier();
  if (index > 0 || level.pins.empty()) return;
  clear_pins(level.residual, workers);
  workers.barrier();
}

}  // namespace weft
