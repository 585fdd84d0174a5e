#include <algorithm>
#include <cmath>

#include "weft/cloth/newton/block_multigrid.h"

// Set-up after a linearisation: Galerkin products, factors of lines, and the sums of seam edges
// while lines are factored.
namespace weft {
namespace {

/// Of the blocks that begin at a plane.
void view_blocks(const PlaneSet& blocks, int first, PlaneView* views) {
  for (int k = 0; k < block_entries; ++k) views[k] = blocks.view(first + k);
}

/// The first plane of the blocks of an edge along a border.
int plane_of(const BorderEdge& edge) { return (edge.along_row ? 1 : 2) * block_entries; }
/// The first plane of its springs.
int spring_plane(const BorderEdge& edge) { return (edge.along_row ? 0 : 1) * spring_entries; }

}  // namespace

const PlaneSet& BlockMultigrid::join_diagonals(Worker& worker) {
  BlockLevel& level = levels_.front();
  if (level.seams.empty()) return level.stencil;
  level.seams.sum(Workers(worker, false), block_entries, level.stencil, parted_centres_.data());
  worker.barrier();
  return level.stencil;
}

/// Puts sums over seam copies in place of the blocks that lines are factored with.
void BlockMultigrid::join_seams(std::size_t index, const Workers& workers) {
  BlockLevel& level = levels_[index];
  if (level.seams.empty()) return;
  workers.barrier();
  if (index == 0) {
    (cloth_.apart ? apart_lines_ : joined_lines_).hold(*springs_, level, workers);
    workers.barrier();
  } else {
    level.seams.sum(workers, block_entries, level.stencil, parted_centres_.data());
    workers.barrier();
  }
  if (workers.rank() == 0) {
    level.mismatch.join(level.stencil);
    join_edges(index);
  }
  workers.barrier();
}

void BlockMultigrid::part_seams(std::size_t index, const Workers& workers) {
  BlockLevel& level = levels_[index];
  if (level.seams.empty()) return;
  workers.barrier();
  if (workers.rank() == 0) {
    level.mismatch.part(level.stencil);
    part_edges(index);
  }
  if (index == 0) return;
  workers.barrier();
  level.seams.restore(workers, block_entries, parted_centres_.data(), level.stencil);
}

/// Lines along a seam couple by the sum of all copies of their edges, as their diagonals do. With
/// one copy's part alone, the line would resist a shift along itself with the stiffness of its
/// threads. While seams are being sewn, copies of a spring have directions of their own, and their
/// sum is not of a spring's form: on the finest level they stay apart.
void BlockMultigrid::join_edges(std::size_t index) {
  parted_.clear();
  if (index == 0 && cloth_.apart) return;
  for (const std::vector<BorderEdge>& group : levels_[index].seams.edges()) {
    if (index == 0) {
      join_springs(group);
      continue;
    }
    PlaneSet& stencil = levels_[index].stencil;
    for (int k = 0; k < block_entries; ++k) {
      float sum = 0;
      const auto entry = [&](const BorderEdge& edge) -> float& {
        return stencil(edge.row, edge.col, plane_of(edge) + k);
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
  springs.line_diagonals_row(
      row, level.extra.row(row),
      {rows_of(level.stencil, row), rows_of(level.held_rows, row), rows_of(level.held_cols, row)});
  clear_pinned_blocks(row);
}

void BlockMultigrid::add_to_diagonals(const ContactProduct::Blocks& blocks, int row, int col) {
  BlockLevel& level = levels_.front();
  if (!(mask_(row, col) > 0)) return;
  for (int k = 0; k < block_entries; ++k) {
    level.stencil(row, col, k) += blocks.whole[k];
    level.held_rows(row, col, k) += blocks.lines[k];
    level.held_cols(row, col, k) += blocks.lines[k];
  }
}

/// Replaces the copies of a spring by their sum. All have one direction, so the sum of t 1 + s s^T
/// is of the same form.
void BlockMultigrid::join_springs(const std::vector<BorderEdge>& group) {
  float across = 0, along = 0;
  const auto entry = [&](const BorderEdge& edge, int k) -> float& {
    return springs_->near()(edge.row, edge.col, spring_plane(edge) + k);
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
  if (parted_.empty()) return;
  std::size_t at = 0;
  PlaneSet& stencil = levels_[index].stencil;
  for (const std::vector<BorderEdge>& group : levels_[index].seams.edges()) {
    if (index == 0) {
      for (const BorderEdge& edge : group)
        for (int k = 0; k < spring_entries; ++k)
          springs_->near()(edge.row, edge.col, spring_plane(edge) + k) = parted_[at++];
      continue;
    }
    for (int k = 0; k < block_entries; ++k)
      for (const BorderEdge& edge : group)
        stencil(edge.row, edge.col, plane_of(edge) + k) = parted_[at++];
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
    if (index == 0) {
      HeldLineMatrix matrix{};
      view_blocks(along_rows ? level.held_rows : level.held_cols, 0, matrix.held);
      const auto views = springs_->views(along_rows ? 0 : 1);
      std::copy(views.begin(), views.end(), matrix.spring);
      lines.factor(block, matrix, *kernels_);
    } else {
      LineMatrix matrix{{}, {level.extra.row(0), level.extra.stride()}, {}};
      view_blocks(level.stencil, 0, matrix.diagonal);
      view_blocks(level.stencil, (along_rows ? 1 : 2) * block_entries, matrix.coupling);
      lines.factor(block, matrix, *kernels_);
    }
  }
}

void BlockMultigrid::set_up(SpringHessian& springs, Worker& worker) {
  const Workers all(worker, false);
  if (worker.rank() == 0) {
    springs_ = &springs;
    choose_bending(springs.time_step());
  }
  worker.barrier();
  for (std::size_t i = 0; i + 1 < levels_.size(); ++i) {
    if (i == 0)
      galerkin_.coarsen(springs, levels_[0], mask_, levels_[1], all, *kernels_);
    else
      galerkin_.coarsen(levels_[i], levels_[i + 1], all, *kernels_);
    worker.barrier();
    if (worker.rank() == 0) levels_[i + 1].mismatch.gather(levels_[i].mismatch, levels_[i].stencil);
    if (levels_[i + 1].short_ends.empty()) continue;
    levels_[i + 1].short_ends.fold(all, levels_[i + 1].stencil);
    worker.barrier();
  }
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    join_seams(i, all);
    factor(i, all);
    part_seams(i, all);
  }
  worker.barrier();
  if (worker.rank() == 0 && coarsest_.active()) coarsest_.factor(levels_.back());
  worker.barrier();
}

}  // namespace weft
