#include "weft/cloth/baselines/multigrid/contact_blocks.h"

#include <algorithm>

#include "weft/cloth/baselines/mip_levels.h"

namespace weft {
namespace {

/// xx, xy, xz, yy, yz, zz
using Block = std::array<float, 6>;

/// (d 1 + c)^-1, by cofactors: d > 0 and c has no negative eigenvalue.
Block inverse_of(float d, const Block& c) {
  if (c == Block{}) return {1 / d, 0, 0, 1 / d, 0, 1 / d};  // most samples of a row touch nothing
  const double xx = double{c[0]} + d, yy = double{c[3]} + d, zz = double{c[5]} + d;
  const double xy = c[1], xz = c[2], yz = c[4];
  const double a = yy * zz - yz * yz, b = xz * yz - xy * zz, e = xy * yz - xz * yy;
  const double scale = 1 / (xx * a + xy * b + xz * e);
  const auto entry = [&](double cofactor) { return static_cast<float>(scale * cofactor); };
  return {entry(a),
          entry(b),
          entry(e),
          entry(xx * zz - xz * xz),
          entry(xy * xz - xx * yz),
          entry(xx * yy - xy * xy)};
}

}  // namespace

ContactBlocks::ContactBlocks(int size)
    : size_(size),
      runs_((size + run_length - 1) / run_length),
      rows_(static_cast<std::size_t>(size)),
      touched_(static_cast<std::size_t>(size) * runs_) {
  for (Grid<float>& plane : own_) plane = Grid<float>(size, size);
  for (Grid<float>& plane : inverse_) plane = Grid<float>(size, size);
}

Block ContactBlocks::block(int sample) const {
  Block block{};
  for (std::size_t i = 0; i < block.size(); ++i) block[i] = own_[i](sample / size_, sample % size_);
  return block;
}

void ContactBlocks::clear_row(int row) {
  if (rows_[row] == 0) return;
  for_runs(row, [&](Range columns, bool was_touched) {
    for (Grid<float>& plane : own_)
      if (was_touched)
        std::fill(plane.row(row) + columns.first, plane.row(row) + columns.last, 0.0F);
  });
  std::fill_n(touched_.begin() + std::ptrdiff_t{row} * runs_, runs_, char{0});
  rows_[row] = 0;
}

void ContactBlocks::touch_row(int row) {
  rows_[row] = 1;
  const float *xx = own_[0].row(row), *yy = own_[3].row(row), *zz = own_[5].row(row);
  // Mates have the blocks of their class, see join_mates, so the whole border counts as touched.
  const bool border = row == 0 || row + 1 == size_;
  for (int run = 0; run < runs_; ++run) {
    char found = border || run == 0 || run + 1 == runs_ ? 1 : 0;
    for (int c = run * run_length; c < std::min(size_, (run + 1) * run_length); ++c)
      if (xx[c] + yy[c] + zz[c] != 0) found = 1;
    touched_[static_cast<std::size_t>(row) * runs_ + run] = found;
  }
}

void ContactBlocks::set_row(const ContactLoads& contacts, int row) {
  clear_row(row);
  if (!contacts.row(row)) return;
  contacts.add_blocks(row, {own_[0].row(row), own_[1].row(row), own_[2].row(row), own_[3].row(row),
                            own_[4].row(row), own_[5].row(row)});
  touch_row(row);
}

void ContactBlocks::restrict_row(const ContactBlocks& fine, int row, float* line) {
  clear_row(row);
  bool any = fine.row(2 * row);
  if (row > 0) any = any || fine.row(2 * row - 1);
  if (2 * row + 1 < fine.size_) any = any || fine.row(2 * row + 1);
  if (!any) return;
  for (std::size_t i = 0; i < own_.size(); ++i)
    restrict_plane_row(fine.own_[i], nullptr, row, line, own_[i].row(row));
  touch_row(row);
}

void ContactBlocks::invert_row(int row, const float* inverse_diagonal) {
  if (rows_[row] == 0) return;
  for_runs(row, [&](Range columns, bool is_touched) {
    for (int c = columns.first; is_touched && c < columns.last; ++c) {
      const float inverse = inverse_diagonal[c];
      const Block found = inverse > 0 ? inverse_of(1 / inverse, block(row * size_ + c)) : Block{};
      for (std::size_t i = 0; i < found.size(); ++i) inverse_[i].row(row)[c] = found[i];
    }
  });
}

void ContactBlocks::join_mates(const BorderMates& mates, const Grid<float>& inverse_diagonal,
                               Range classes) {
  for (int index = classes.first; index < classes.last; ++index) {
    const std::span<const int> samples = mates.mates(index);
    Block sum{};
    for (const int s : samples)
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += own_[i](s / size_, s % size_);
    const float inverse = inverse_diagonal(samples.front() / size_, samples.front() % size_);
    const Block found = inverse > 0 ? inverse_of(1 / inverse, sum) : Block{};
    for (const int s : samples)
      for (std::size_t i = 0; i < found.size(); ++i) inverse_[i](s / size_, s % size_) = found[i];
  }
}

}  // namespace weft
