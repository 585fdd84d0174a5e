#include "weft/collide/untangle/smooth_move.h"

#include <algorithm>

namespace weft {

void SmoothMove::clear(const SurfaceGrid& grid, int levels) {
  sides_.assign(1, grid.size());
  while (static_cast<int>(sides_.size()) <= levels && sides_.back() > 2)
    sides_.push_back(sides_.back() / 2 + 1);
  moves_.resize(sides_.size());
  for (std::size_t level = 0; level < sides_.size(); ++level)
    moves_[level].assign(static_cast<std::size_t>(sides_[level]) * sides_[level], {});
}

void SmoothMove::want(int sample, Vec3d move, double weight) {
  Wanted& wanted = moves_.front()[sample];
  wanted.move += weight * move;
  wanted.weight += weight;
}

/// Turns sums into means of weight 1 at most, equal for all samples of a class.
void SmoothMove::gather_classes(const SurfaceGrid& grid) {
  std::vector<Wanted>& finest = moves_.front();
  for (Wanted& wanted : finest) {
    if (!(wanted.weight > 0)) continue;
    wanted.move = (1 / wanted.weight) * wanted.move;
    wanted.weight = std::min(1.0, wanted.weight);
  }
  for (int s = 0; s < grid.size() * grid.size(); ++s)
    if (grid.point(s) != s) finest[s] = finest[grid.point(s)];
}

/// Restriction to every second sample: weighted means of the samples around it.
void SmoothMove::pull(std::size_t level) {
  const int fine = sides_[level - 1], coarse = sides_[level];
  for (int r = 0; r < coarse; ++r)
    for (int c = 0; c < coarse; ++c) {
      Wanted sum;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
          const int row = 2 * r + i, col = 2 * c + j;
          if (row < 0 || col < 0 || row >= fine || col >= fine) continue;
          const Wanted& from = moves_[level - 1][row * fine + col];
          const double weight = (i == 0 ? 1 : 0.5) * (j == 0 ? 1 : 0.5) * from.weight;
          sum.move += weight * from.move;
          sum.weight += weight;
        }
      if (sum.weight > 0) sum.move = (1 / sum.weight) * sum.move;
      sum.weight = std::min(1.0, sum.weight);
      moves_[level][r * coarse + c] = sum;
    }
}

/// Prolongation: bilinear interpolation supplies what a sample's weight lacks to 1.
void SmoothMove::push(std::size_t level) {
  const int fine = sides_[level - 1], coarse = sides_[level];
  for (int r = 0; r < fine; ++r)
    for (int c = 0; c < fine; ++c) {
      Wanted& wanted = moves_[level - 1][r * fine + c];
      if (wanted.weight >= 1) continue;
      const int r0 = r / 2, r1 = (r + 1) / 2, c0 = c / 2, c1 = (c + 1) / 2;
      const auto of = [&](int row, int col) { return moves_[level][row * coarse + col].move; };
      const Vec3d mean = 0.25 * (of(r0, c0) + of(r0, c1) + of(r1, c0) + of(r1, c1));
      wanted.move = wanted.weight * wanted.move + (1 - wanted.weight) * mean;
    }
}

void SmoothMove::spread(const SurfaceGrid& grid) {
  gather_classes(grid);
  for (std::size_t level = 1; level < sides_.size(); ++level) pull(level);
  for (Wanted& wanted : moves_.back()) wanted.move = wanted.weight * wanted.move;
  for (std::size_t level = sides_.size() - 1; level > 0; --level) push(level);
}

}  // namespace weft
