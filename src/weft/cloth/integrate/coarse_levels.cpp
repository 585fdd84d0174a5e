#include "weft/cloth/integrate/coarse_levels.h"

#include <algorithm>

#include "weft/cloth/integrate/blocks.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/mip_levels.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

constexpr int least_level_size = 3;
// The diagonal of a level against the mean diagonal of the finest: a bilinear hat of half-width s
// has the spring energy 4/3 k where a single sample has 2 k (a little more for its diagonals),
// whatever s is, and 4/9 of the mass that its weights sum up.
constexpr float spring_share = 0.7F, mass_share = 4.0F / 9;

void multiply_row(const Blocks& blocks, Planes3& values, int row) {
  const Row3 v = row_of(values, row);
  std::array<const float*, 6> d{};
  for (int i = 0; i < 6; ++i) d[i] = blocks[i].row(row);
  for (int c = 0; c < values.size(); ++c) {
    const float x = v.x[c], y = v.y[c], z = v.z[c];
    v.x[c] = d[0][c] * x + d[1][c] * y + d[2][c] * z;
    v.y[c] = d[1][c] * x + d[3][c] * y + d[4][c] * z;
    v.z[c] = d[2][c] * x + d[4][c] * y + d[5][c] * z;
  }
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

CoarseLevels::CoarseLevels(const Cloth& cloth)
    : cloth_(cloth),
      finest_(make_level(cloth.mates)),
      share_(finest_.share),
      moves_(cloth.size, cloth.size) {
  BorderMates mates = cloth.mates;
  while (mates.size() % 2 == 1 && (mates.size() - 1) / 2 + 1 >= least_level_size) {
    Level& fine = levels_.empty() ? finest_ : levels_.back();
    fine.cut_below = !halves(mates);
    mates = fine.cut_below ? BorderMates((mates.size() - 1) / 2 + 1, {}) : halved(mates);
    levels_.push_back(make_level(mates));
  }
}

/// The finest level's masses and blocks; those of pinned particles are left out of the masses
/// alone.
void CoarseLevels::take_row(const Blocks& diagonal, int row) {
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

void CoarseLevels::take_contacts_row(const ContactTerms& contacts, int row) {
  for (int i = 0; i < 6; ++i) {
    const float* block = contacts.blocks()[i].row(row);
    std::copy(block, block + cloth_.size, finest_.contact[i].row(row));
  }
}

void CoarseLevels::invert_row(Level& level, bool contacts, int row) {
  for (int c = 0; c < level.size(); ++c) {
    const float mass = mass_share * level.mass(row, c);
    const auto entry = [&](int i) {
      const float held = contacts ? mass_share * level.contact[i](row, c) : 0.0F;
      return spring_share * level.spring[i](row, c) + held;
    };
    const Symmetric3 block{entry(0) + mass, entry(1), entry(2),
                           entry(3) + mass, entry(4), entry(5) + mass};
    const bool moves = block.xx + block.yy + block.zz > 0;
    const Symmetric3 result = moves ? inverse(block) : Symmetric3{};
    level.inverse[0](row, c) = result.xx;
    level.inverse[1](row, c) = result.xy;
    level.inverse[2](row, c) = result.xz;
    level.inverse[3](row, c) = result.yy;
    level.inverse[4](row, c) = result.yz;
    level.inverse[5](row, c) = result.zz;
  }
}

void CoarseLevels::coarsen_row(const Level& fine, bool contacts, Level& coarse, int row) {
  const int last = coarse.size() - 1;
  float* line = coarse.line.row(row);
  restrict_plane_row(fine.mass, &fine.share, row, line, coarse.mass.row(row));
  for (int i = 0; i < 6; ++i) {
    float* out = coarse.spring[i].row(row);
    restrict_plane_row(fine.spring[i], nullptr, row, line, out);
    // The weights that were summed, so that a mean remains.
    const float height = row == 0 || row == last ? 1.5F : 2.0F;
    for (int c = 0; c <= last; ++c) out[c] /= height * (c == 0 || c == last ? 1.5F : 2.0F);
    if (contacts)
      restrict_plane_row(fine.contact[i], &fine.share, row, line, coarse.contact[i].row(row));
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
    take_row(diagonal, r);
    if (held) take_contacts_row(contacts, r);
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

void CoarseLevels::restrict_row(const Level& fine, const Planes3& in, Level& coarse, int row) {
  float* line = coarse.line.row(row);
  const Row3 out = row_of(coarse.value, row);
  restrict_plane_row(in.x, &fine.share, row, line, out.x);
  restrict_plane_row(in.y, &fine.share, row, line, out.y);
  restrict_plane_row(in.z, &fine.share, row, line, out.z);
}

/// Residual to correction, with what the levels below found.
void CoarseLevels::correct_row(Level& level, const Level* below, int row) {
  multiply_row(level.inverse, level.value, row);
  if (below == nullptr) return;
  const Row3 out = row_of(level.value, row);
  add_interpolated_row(below->value.x, row, nullptr, out.x);
  add_interpolated_row(below->value.y, row, nullptr, out.y);
  add_interpolated_row(below->value.z, row, nullptr, out.z);
}

/// All levels but the first: a third of its work, not worth their barriers.
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

void CoarseLevels::add_row(Planes3& out, int row) const {
  const Planes3& value = levels_.front().value;
  const Row3 to = row_of(out, row);
  const float* moves = moves_.row(row);
  add_interpolated_row(value.x, row, moves, to.x);
  add_interpolated_row(value.y, row, moves, to.y);
  add_interpolated_row(value.z, row, moves, to.z);
}

}  // namespace weft
