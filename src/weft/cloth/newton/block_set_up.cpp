#include <algorithm>
#include <cmath>

#include "weft/cloth/newton/block_multigrid.h"

// Set-up after a linearisation: Galerkin products, factors of lines, and the sums of seam edges
// while lines are factored.
namespace weft {
namespace {

void view_blocks(const PaddedBlocks& blocks, PlaneView* views) {
  for (int k = 0; k < 6; ++k) views[k] = {blocks.entry[k].row(0), blocks.entry[k].stride()};
}

}  // namespace

void BlockMultigrid::join_centres(BlockLevel& level, const Workers& workers) {
  if (level.seams.empty()) return;
  const Range mine = workers.share(level.size);
  for (int k = 0; k < 6; ++k)
    for (int r = mine.first; r < mine.last; ++r)
      std::copy_n(level.stencil.centre.entry[k].row(r), level.size, level.joined.entry[k].row(r));
  workers.barrier();
  auto& e = level.joined.entry;
  level.seams.sum(workers, {&e[0], &e[1], &e[2], &e[3], &e[4], &e[5]});
  workers.barrier();
}

/// Lines along a seam couple by the sum of all copies of their edges, as their diagonals do. With
/// one copy's part alone, the line would resist a shift along itself with the stiffness of its
/// threads. While seams are being sewn, copies of a spring have directions of their own, and their
/// sum is not of a spring's form: on the finest level they stay apart.
void BlockMultigrid::join_edges(std::size_t index) {
  parted_.clear();
  for (const std::vector<BorderEdge>& group : levels_[index].seams.edges()) {
    if (index == 0) {
      join_springs(group);
      continue;
    }
    BlockStencil& stencil = levels_[index].stencil;
    for (int k = 0; k < 6; ++k) {
      float sum = 0;
      const auto entry = [&](const BorderEdge& edge) -> float& {
        PaddedBlocks& blocks = edge.along_row ? stencil.right : stencil.below;
        return blocks.entry[k](edge.row, edge.col);
      };
      for (const BorderEdge& edge : group) {
        sum += entry(edge);
        parted_.push_back(entry(edge));
      }
      for (const BorderEdge& edge : group) entry(edge) = sum;
    }
  }
}

void BlockMultigrid::fill_diagonals(const SpringHessian& springs, int row) {
  BlockLevel& level = levels_.front();
  if (level.seams.empty())
    springs.line_diagonals_row(row, level.extra.row(row),
                               {row_of(level.stencil.centre, row), row_of(level.held_rows, row),
                                row_of(level.held_cols, row)});
  else
    springs.diagonal_row(row, level.stencil.centre);
  clear_pinned_blocks(row);
}

/// Clears the centres of pinned samples, which have no part in coarser levels.
void BlockMultigrid::clear_pinned_blocks(int row) {
  for (int i = pin_starts_[row]; i < pin_starts_[row + 1]; ++i)
    for (PaddedPlane& entry : levels_.front().stencil.centre.entry)
      entry(row, pinned_[i] % cloth_.size) = 0;
}

void BlockMultigrid::add_to_diagonals(const BlockRow6& blocks, int row) {
  BlockLevel& level = levels_.front();
  const auto add = [&](PaddedBlocks& to) {
    for (int k = 0; k < 6; ++k)
      for (int c = 0; c < level.size; ++c) to.entry[k](row, c) += blocks.entry[k][c];
  };
  add(level.stencil.centre);
  clear_pinned_blocks(row);
  if (!level.seams.empty()) return;
  add(level.held_rows);
  add(level.held_cols);
}

/// Replaces the copies of a spring by their sum. All have one direction, so the sum of t 1 + s s^T
/// is of the same form.
void BlockMultigrid::join_springs(const std::vector<BorderEdge>& group) {
  float across = 0, along = 0;
  const auto entry = [&](const BorderEdge& edge, int k) -> float& {
    return (*springs_->planes(edge.along_row ? 0 : 1)[k])(edge.row, edge.col);
  };
  const auto squared = [&](const BorderEdge& edge) {
    return entry(edge, 1) * entry(edge, 1) + entry(edge, 2) * entry(edge, 2) +
           entry(edge, 3) * entry(edge, 3);
  };
  for (const BorderEdge& edge : group) {
    across += entry(edge, 0);
    along += squared(edge);
  }
  for (const BorderEdge& edge : group) {
    const float own = squared(edge), factor = own > 0 ? std::sqrt(along / own) : 1;
    for (int k = 0; k < 4; ++k) {
      parted_.push_back(entry(edge, k));
      entry(edge, k) = k == 0 ? across : factor * entry(edge, k);
    }
  }
}

void BlockMultigrid::part_edges(std::size_t index) {
  std::size_t at = 0;
  BlockStencil& stencil = levels_[index].stencil;
  for (const std::vector<BorderEdge>& group : levels_[index].seams.edges()) {
    if (index == 0) {
      for (const BorderEdge& edge : group)
        for (PaddedPlane* plane : springs_->planes(edge.along_row ? 0 : 1))
          (*plane)(edge.row, edge.col) = parted_[at++];
      continue;
    }
    for (int k = 0; k < 6; ++k)
      for (const BorderEdge& edge : group)
        (edge.along_row ? stencil.right : stencil.below).entry[k](edge.row, edge.col) =
            parted_[at++];
  }
}

void BlockMultigrid::factor(std::size_t index, const Workers& workers) {
  BlockLevel& level = levels_[index];
  const int blocks = level.rows.blocks();
  const Range mine = workers.share(2 * blocks);
  for (int b = mine.first; b < mine.last; ++b) {
    const bool along_rows = b < blocks;
    LineFactor& lines = along_rows ? level.rows : level.cols;
    const int block = along_rows ? b : b - blocks;
    const PlaneView extra{level.extra.row(0), level.extra.stride()};
    if (index == 0 && level.seams.empty()) {
      HeldLineMatrix matrix{};
      view_blocks(along_rows ? level.held_rows : level.held_cols, matrix.held);
      const auto views = springs_->views(along_rows ? 0 : 1);
      std::copy(views.begin(), views.end(), matrix.spring);
      lines.factor(block, matrix, *kernels_);
    } else if (index == 0) {
      SpringLineMatrix matrix{{}, extra, {}};
      view_blocks(level.diagonal(), matrix.diagonal);
      const auto views = springs_->views(along_rows ? 0 : 1);
      std::copy(views.begin(), views.end(), matrix.coupling);
      lines.factor(block, matrix, *kernels_);
    } else {
      LineMatrix matrix{{}, extra, {}};
      view_blocks(level.diagonal(), matrix.diagonal);
      view_blocks(along_rows ? level.stencil.right : level.stencil.below, matrix.coupling);
      lines.factor(block, matrix, *kernels_);
    }
  }
}

void BlockMultigrid::set_up(SpringHessian& springs, Worker& worker) {
  const Workers all(worker, false);
  if (worker.rank() == 0) springs_ = &springs;
  worker.barrier();
  join_centres(levels_.front(), all);
  for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
    if (i == 0)
      galerkin_.coarsen(springs, levels_[0], mask_, levels_[1], all, *kernels_);
    else
      galerkin_.coarsen(levels_[i], levels_[i + 1], all, *kernels_);
    worker.barrier();
    join_centres(levels_[i + 1], all);
  }
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const bool seamed = !levels_[i].seams.edges().empty() && (i > 0 || !cloth_.apart);
    if (seamed) {
      worker.barrier();
      if (worker.rank() == 0) join_edges(i);
      worker.barrier();
    }
    factor(i, all);
    if (!seamed) continue;
    worker.barrier();
    if (worker.rank() == 0) part_edges(i);
  }
  if (worker.rank() == 0 && coarsest_.active()) coarsest_.factor(levels_.back());
  worker.barrier();
}

}  // namespace weft
