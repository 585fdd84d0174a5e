#include "weft/cloth/baselines/coarse_levels.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "weft/cloth/baselines/mip_levels.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

// The diagonal of a level over the mean diagonal of the finest: a bilinear hat of half-width s has
// the spring energy 4/3 k where a single sample has 2 k (a little more for its diagonals), whatever
// s is, and 4/9 of the mass that its weights sum up.
constexpr float spring_share = 0.7F, mass_share = 4.0F / 9;

/// The three rows of a fine plane that a coarse row is restricted from, with their weights.
WeighedRows rows_around(const Grid<float>& fine, const Grid<float>* weight, int row) {
  const int r = 2 * row;
  const auto at = [&](const Grid<float>* plane, int from) {
    return plane == nullptr || from < 0 || from >= fine.rows() ? nullptr : plane->row(from);
  };
  return {at(&fine, r - 1),  fine.row(r),   at(&fine, r + 1),
          at(weight, r - 1), at(weight, r), at(weight, r + 1)};
}

}  // namespace

CoarseLevels::Level CoarseLevels::make_level(const BorderMates& mates) {
  const int n = mates.size();
  Level level{mates, Grid<float>(n, n, 1), Planes3(n), Grid<float>(n, n), {}, {},
              {},    Grid<float>(n, 2 * n)};
  for (int index = 0; index < mates.class_count(); ++index)
    for (const int s : mates.mates(index))
      level.share(s / n, s % n) = 1 / static_cast<float>(mates.mates(index).size());
  for (Blocks* blocks : {&level.spring, &level.contact, &level.inverse})
    for (Grid<float>& plane : *blocks) plane = Grid<float>(n, n);
  return level;
}

CoarseLevels::CoarseLevels(const Cloth& cloth, InstructionSet instructions)
    : cloth_(cloth),
      table_(kernels_for(instructions)),
      kernels_(implicit_kernels_for(instructions)),
      finest_(make_level(cloth.mates)),
      share_(finest_.share),
      moves_(cloth.size, cloth.size) {
  BorderMates mates = cloth.mates;
  while (mates.size() % 2 == 1 && (mates.size() - 1) / 2 + 1 >= min_level_size) {
    Level& fine = levels_.empty() ? finest_ : levels_.back();
    fine.cut_below = !halves(mates);
    mates = fine.cut_below ? BorderMates((mates.size() - 1) / 2 + 1, {}) : halved(mates);
    levels_.push_back(make_level(mates));
  }
}

/// Takes a row of the finest level's masses and blocks. Of pinned particles only the spring blocks
/// count on coarser levels, since their share is 0.
void CoarseLevels::set_row(const Blocks& diagonal, int row) {
  for (int c = 0; c < cloth_.size; ++c) {
    moves_(row, c) = cloth_.inverse_mass(row, c) > 0 ? 1.0F : 0.0F;
    finest_.share(row, c) = moves_(row, c) * share_(row, c);
    finest_.mass(row, c) = cloth_.mass(row, c);
  }
  for (int i = 0; i < 6; ++i) {
    const bool on_diagonal = i == 0 || i == 3 || i == 5;
    for (int c = 0; c < cloth_.size; ++c)
      finest_.spring[i](row, c) = diagonal[i](row, c) - (on_diagonal ? cloth_.mass(row, c) : 0.0F);
  }
}

void CoarseLevels::add_contacts_row(const ContactTerms& contacts, int row) {
  for (int i = 0; i < 6; ++i) {
    const float* block = contacts.blocks()[i].row(row);
    std::copy(block, block + cloth_.size, finest_.contact[i].row(row));
  }
}

void CoarseLevels::invert_row(Level& level, bool contacts, int row) const {
  const Blocks &spring = level.spring, &contact = level.contact;
  kernels_.invert_blocks(
      level.size(),
      {row_of(spring, row), contacts ? row_of(contact, row) : row_of(spring, row),
       level.mass.row(row), nullptr, spring_share, contacts ? mass_share : 0, mass_share},
      row_of(level.inverse, row));
}

void CoarseLevels::coarsen_row(const Level& fine, bool contacts, Level& coarse, int row) const {
  const int n = fine.size(), last = coarse.size() - 1;
  float* line = coarse.line.row(row);
  kernels_.restrict_plane(n, rows_around(fine.mass, &fine.share, row), line, coarse.mass.row(row));
  for (int i = 0; i < 6; ++i) {
    float* out = coarse.spring[i].row(row);
    kernels_.restrict_plane(n, rows_around(fine.spring[i], nullptr, row), line, out);
    // Divided by the sum of the weights, which gives the mean.
    const float height = row == 0 || row == last ? 1.5F : 2.0F;
    for (int c = 0; c <= last; ++c) out[c] /= height * (c == 0 || c == last ? 1.5F : 2.0F);
    if (contacts)
      kernels_.restrict_plane(n, rows_around(fine.contact[i], &fine.share, row), line,
                              coarse.contact[i].row(row));
  }
}

void CoarseLevels::sum_level(Level& level, bool contacts, Worker& worker) {
  Blocks &spring = level.spring, &held = level.contact;
  sum_over_mates(level.mates, worker, {&level.mass});
  average_over_mates(level.mates, worker,
                     {&spring[0], &spring[1], &spring[2], &spring[3], &spring[4], &spring[5]});
  if (contacts)
    sum_over_mates(level.mates, worker,
                   {&held[0], &held[1], &held[2], &held[3], &held[4], &held[5]});
}

void CoarseLevels::prepare(const Blocks& diagonal, const ContactTerms& contacts, Worker& worker) {
  const bool held = !contacts.empty();
  const Range rows = worker.share(cloth_.size);
  for (int r = rows.first; r < rows.last; ++r) {
    set_row(diagonal, r);
    if (held) add_contacts_row(contacts, r);
  }
  worker.barrier();
  const Level* fine = &finest_;
  for (Level& level : levels_) {
    const Range mine = worker.share(level.size());
    for (int r = mine.first; r < mine.last; ++r) coarsen_row(*fine, held, level, r);
    worker.barrier();
    sum_level(level, held, worker);
    worker.barrier();
    for (int r = mine.first; r < mine.last; ++r) invert_row(level, held, r);
    fine = &level;
  }
  worker.barrier();
}

void CoarseLevels::restrict_row(const Level& fine, const Planes3& in, Level& coarse,
                                int row) const {
  float* line = coarse.line.row(row);
  const Row3 out = row_of(coarse.value, row);
  kernels_.restrict_plane(fine.size(), rows_around(in.x, &fine.share, row), line, out.x);
  kernels_.restrict_plane(fine.size(), rows_around(in.y, &fine.share, row), line, out.y);
  kernels_.restrict_plane(fine.size(), rows_around(in.z, &fine.share, row), line, out.z);
}

/// Three rows of the next coarser level, in the scratch of a row.
Row3 CoarseLevels::interpolation_lines(Level& level, int row) const {
  float* line = level.line.row(row);
  const int coarse = (level.size() + 1) / 2;
  return {line, line + coarse, line + 2 * std::ptrdiff_t{coarse}};
}

/// Turns a row's residual into its correction and adds that of the coarser levels, interpolated.
void CoarseLevels::correct_row(Level& level, const Level* below, int row) const {
  const Row3 out = row_of(level.value, row);
  kernels_.multiply_blocks(level.size(), row_of(std::as_const(level.inverse), row), out);
  if (below == nullptr) return;
  table_.interpolate(level.size(), row_of(below->value, row / 2),
                     row_of(below->value, (row + 1) / 2), level.share.row(row),
                     interpolation_lines(level, row), out);
}

/// Solves all levels but the first, by one worker: a third of the first one's work, not worth
/// barriers.
void CoarseLevels::solve_below() {
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    Level& level = levels_[i];
    for (int r = 0; r < level.size(); ++r)
      restrict_row(levels_[i - 1], levels_[i - 1].value, level, r);
    sum_over_mates(level.mates, {&level.value.x, &level.value.y, &level.value.z});
  }
  for (std::size_t i = levels_.size(); --i > 0;) {
    const Level* below = i + 1 < levels_.size() ? &levels_[i + 1] : nullptr;
    for (int r = 0; r < levels_[i].size(); ++r) correct_row(levels_[i], below, r);
    Planes3& value = levels_[i].value;
    if (levels_[i].cut_below) average_over_mates(levels_[i].mates, {&value.x, &value.y, &value.z});
  }
}

void CoarseLevels::solve(const Planes3& residual, Worker& worker) {
  Level& first = levels_.front();
  const Range mine = worker.share(first.size());
  for (int r = mine.first; r < mine.last; ++r) restrict_row(finest_, residual, first, r);
  worker.barrier();
  sum_over_mates(first.mates, worker, {&first.value.x, &first.value.y, &first.value.z});
  worker.barrier();
  if (worker.rank() == 0) solve_below();
  worker.barrier();
  const Level* below = levels_.size() > 1 ? &levels_[1] : nullptr;
  for (int r = mine.first; r < mine.last; ++r) correct_row(first, below, r);
  worker.barrier();
  if (!first.cut_below) return;
  average_over_mates(first.mates, worker, {&first.value.x, &first.value.y, &first.value.z});
  worker.barrier();
}

void CoarseLevels::add_row(Planes3& out, int row) {
  const Planes3& value = levels_.front().value;
  table_.interpolate(cloth_.size, row_of(value, row / 2), row_of(value, (row + 1) / 2),
                     moves_.row(row), interpolation_lines(finest_, row), row_of(out, row));
}

}  // namespace weft
