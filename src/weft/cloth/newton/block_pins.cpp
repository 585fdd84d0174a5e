#include <utility>

#include "weft/cloth/newton/block_multigrid.h"

// Pins on all levels.
namespace weft {
namespace {

/// The nodes of a coarse level at pinned samples of a finer one; around a sample that lies between
/// nodes, all of those.
std::vector<bool> coarse_pins(const std::vector<bool>& pinned, const LevelLayout& fine,
                              const LevelLayout& coarse) {
  std::vector<bool> result(static_cast<std::size_t>(coarse.size) * coarse.size, false);
  for (std::size_t k = 0; k < fine.charts.size(); ++k) {
    const Chart &from = fine.charts[k], &to = coarse.charts[k];
    for (int r = 0; r < from.rows; ++r)
      for (int c = 0; c < from.cols; ++c) {
        if (!pinned[(from.row + r) * fine.size + from.col + c]) continue;
        for (const int row : {r / 2, (r + 1) / 2})
          for (const int col : {c / 2, (c + 1) / 2})
            result[(to.row + row) * coarse.size + to.col + col] = true;
      }
  }
  return result;
}

}  // namespace

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
  if (!levels_.front().pin_starts.empty() && !pins_changed()) return false;
  const int n = cloth_.size;
  std::vector<bool> pinned(static_cast<std::size_t>(n) * n, false);
  for (int s = 0; s < n * n; ++s) {
    const bool moves = cloth_.inverse_mass(s / n, s % n) > 0;
    mask_(s / n, s % n) = moves ? 1.0F : 0.0F;
    pinned[s] = !moves && !cloth_.mates.is_hole(s);
  }
  set_pins(levels_.front(), pinned);
  hold_pins(levels_.front(), true);
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    pinned = coarse_pins(pinned, levels_[i - 1].layout, levels_[i].layout);
    set_pins(levels_[i], pinned);
  }
  return true;
}

/// Without holding them yet. @param pinned  [size * size] of the level
void BlockMultigrid::set_pins(BlockLevel& level, const std::vector<bool>& pinned) {
  hold_pins(level, false);
  level.pins.clear();
  level.pin_starts.assign(static_cast<std::size_t>(level.size) + 1, 0);
  for (int s = 0; s < level.size * level.size; ++s) {
    const int row = s / level.size;
    if (pinned[s]) level.pins.push_back({s, level.extra(row, s % level.size)});
    level.pin_starts[row + 1] = static_cast<int>(level.pins.size());
  }
}

void BlockMultigrid::hold_pins(BlockLevel& level, bool held) {
  level.holds_pins = held && !level.pins.empty();
  for (const BlockLevel::Pin& pin : level.pins)
    level.extra(pin.sample / level.size, pin.sample % level.size) =
        held ? holding_stiffness : pin.extra;
}

void BlockMultigrid::clear_pins(PaddedVectors& field, const Workers& workers) const {
  const BlockLevel& level = levels_.front();
  const Range mine = workers.share(static_cast<int>(level.pins.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const int r = level.pins[i].sample / level.size, c = level.pins[i].sample % level.size;
    field.x(r, c) = field.y(r, c) = field.z(r, c) = 0;
  }
}

/// Where the level holds them.
void BlockMultigrid::clear_pins_of_row(const BlockLevel& level, int row, PaddedVectors& field) {
  if (!level.holds_pins) return;
  for (int i = level.pin_starts[row]; i < level.pin_starts[row + 1]; ++i) {
    const int c = level.pins[i].sample % level.size;
    field.x(row, c) = field.y(row, c) = field.z(row, c) = 0;
  }
}

/// Clears the centres of pinned samples of the finest level, which have no part in coarser ones.
void BlockMultigrid::clear_pinned_blocks(int row) {
  BlockLevel& level = levels_.front();
  for (int i = level.pin_starts[row]; i < level.pin_starts[row + 1]; ++i)
    for (int k = 0; k < block_entries; ++k)
      level.stencil(row, level.pins[i].sample % level.size, k) = 0;
}

}  // namespace weft
