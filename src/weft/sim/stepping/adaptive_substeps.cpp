#include "weft/sim/stepping/adaptive_substeps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/mesh/box_tree.h"

namespace weft {
namespace {

/// Samples a side of a block.
constexpr int block_size = 16;
/// Levels beyond those that bodies require, to which steps may be halved where points fall back.
constexpr int levels_for_fallen = 5;

Box3d padded(const Box3d& box, double by) {
  const Vec3d aside{by, by, by};
  return {box.lower - aside, box.upper + aside};
}

}  // namespace

double ApproachRule::parts(double approach) const {
  const double speed = approach / seconds;
  const double gaps = std::clamp(max_gaps * calm_speed / speed, min_gaps, max_gaps);
  return approach / (gaps * gap);
}

ClothReach::ClothReach(int size) {
  const std::size_t blocks = static_cast<std::size_t>(size - 2) / block_size + 1;
  blocks_.reserve(blocks * blocks);
  columns_.reserve(6 * static_cast<std::size_t>(size));
}

/// Widens the extents of one coordinate of a row's samples, where they are and where they fly to.
void ClothReach::widen(const float* position, const float* velocity, float seconds, int size,
                       float* lower, float* upper) {
#pragma omp simd
  for (int c = 0; c < size; ++c) {
    const float from = position[c], to = from + seconds * velocity[c];
    const float less = from < to ? from : to, more = from < to ? to : from;
    lower[c] = lower[c] < less ? lower[c] : less;
    upper[c] = upper[c] > more ? upper[c] : more;
  }
}

void ClothReach::place(const ClothState& cloth, double seconds, double padding) noexcept {
  const int n = cloth.position.size();
  const auto samples = static_cast<std::size_t>(n);
  const std::array positions{&cloth.position.x, &cloth.position.y, &cloth.position.z};
  const std::array velocities{&cloth.velocity.x, &cloth.velocity.y, &cloth.velocity.z};
  blocks_.clear();
  whole_ = {};
  for (int row = 0; row + 1 < n; row += block_size) {
    columns_.assign(3 * samples, HUGE_VALF);
    columns_.resize(6 * samples, -HUGE_VALF);
    float *lower = columns_.data(), *upper = lower + 3 * samples;
    // Includes the first samples of the next blocks, so that no gap is left between blocks.
    for (int r = row; r <= std::min(n - 1, row + block_size); ++r)
      for (std::size_t axis = 0; axis < 3; ++axis)
        widen(positions[axis]->row(r), velocities[axis]->row(r), static_cast<float>(seconds), n,
              lower + axis * samples, upper + axis * samples);
    for (int col = 0; col + 1 < n; col += block_size) add_block(lower, upper, col, n, padding);
  }
}

/// Adds the block of some columns. @param lower, upper  [3 x n] of columns
void ClothReach::add_block(const float* lower, const float* upper, int col, int size,
                           double padding) {
  const int last = std::min(size, col + block_size + 1);
  const auto least = [&](int axis) {
    return double{*std::min_element(lower + axis * size + col, lower + axis * size + last)};
  };
  const auto most = [&](int axis) {
    return double{*std::max_element(upper + axis * size + col, upper + axis * size + last)};
  };
  blocks_.push_back(padded({{least(0), least(1), least(2)}, {most(0), most(1), most(2)}}, padding));
  whole_.add(blocks_.back().lower);
  whole_.add(blocks_.back().upper);
}

bool ClothReach::meets(const Box3d& box) const noexcept {
  return overlap(whole_, box) && std::any_of(blocks_.begin(), blocks_.end(),
                                             [&](const Box3d& b) { return overlap(b, box); });
}

namespace {

/// The steps that a part of a body asks for.
struct StepNeed {
  const BlockMotion& motion;
  const ApproachRule& rule;

  [[nodiscard]] double of(double approach, double turn) const {
    return std::max(rule.parts(approach), turn / max_turn);
  }
  [[nodiscard]] double of_sample(int row, int col) const {
    if (const SurfaceMotion* surface = motion.surface())
      return of(surface->approach(row, col), surface->turn(row, col));
    return of(length(motion.end().at(row, col) - motion.start().at(row, col)), 0);
  }
};

/// The most that a triangle near the cloth asks for, of those of a block, if it is more than
/// `wanted`.
double wanted_by(const BlockMotion::Block& block, const StepNeed& need, const ClothReach& cloth,
                 double wanted) {
  constexpr int wide = BlockMotion::block_size + 1;
  std::array<std::array<double, wide>, wide> needs{};
  for (int r = block.first_row; r <= block.last_row; ++r)
    for (int c = block.first_col; c <= block.last_col; ++c)
      needs[r - block.first_row][c - block.first_col] = need.of_sample(r, c);
  const SurfaceGrid& grid = need.motion.grid();
  for (int r = block.first_row; r < block.last_row; ++r)
    for (int c = block.first_col; c < block.last_col; ++c)
      for (const int half : {0, 1}) {
        const std::array<int, 3> corners = grid.triangle(r, c, half);
        double own = 0;
        Box3d way;
        for (const int s : corners) {
          own = std::max(
              own, needs[s / grid.size() - block.first_row][s % grid.size() - block.first_col]);
          for (const Planes3* at : {&need.motion.start(), &need.motion.end()})
            way.add(vec_cast<double>(at->at(s)));
        }
        if (own > wanted && !grid.folded(corners) && cloth.meets(way)) wanted = own;
      }
  return wanted;
}

}  // namespace

double wanted_subdivisions(const BlockMotion& motion, const ClothReach& cloth,
                           const ApproachRule& rule) noexcept {
  double wanted = 1;
  if (rule.parts(motion.max_moved()) <= 1) return wanted;
  const StepNeed need{motion, rule};
  for (const BlockMotion::Block& block : motion.blocks()) {
    // What single samples ask for may round to a little more.
    constexpr double rounding = 1e-5;
    if ((1 + rounding) * need.of(block.approach, block.turn) <= wanted) continue;
    const Box3d way{vec_cast<double>(block.swept.lower), vec_cast<double>(block.swept.upper)};
    if (cloth.meets(way)) wanted = wanted_by(block, need, cloth, wanted);
  }
  return wanted;
}

int whole_subdivisions(double wanted) noexcept {
  int subdivisions = 1;
  while (subdivisions < max_subdivisions && subdivisions < wanted) subdivisions *= 2;
  return subdivisions;
}

StepWalk::StepWalk(int least, const StepLevels& levels)
    : min_level_(least),
      first_(std::max(least, levels.first)),
      level_(first_),
      max_level_(std::max(first_, levels.most)),
      max_fallen_level_(std::max(max_level_, min_level_ + levels_for_fallen)) {}

void StepWalk::require(int level) {
  min_level_ = std::max(min_level_, level);
  first_ = std::max(first_, min_level_);
  level_ = std::max(level_, first_);
  max_level_ = std::max(max_level_, first_);
  max_fallen_level_ = std::max(max_level_, min_level_ + levels_for_fallen);
}

void StepWalk::halve() {
  ++level_;
  halved_ = true;
  calm_ = false;
}

void StepWalk::accept(StepVerdict verdict) {
  done_ += whole >> level_;
  calm_ = calm_ && verdict == StepVerdict::calm;
  if (verdict == StepVerdict::fallen) max_fallen_level_ = level_;
  if (verdict == StepVerdict::forced || verdict == StepVerdict::fallen) {
    // Halving has not helped: the rest of the substep is halved no further.
    forced_ = true;
    max_level_ = level_;
  }
  const bool aligned = level_ > 0 && done_ % (whole >> (level_ - 1)) == 0;
  if (level_ > first_ && aligned && verdict == StepVerdict::calm) --level_;
}

StepLevels StepWalk::next(const StepLevels& levels) const {
  StepLevels next = levels;
  if (halved_)
    next.first = level_;
  else if (calm_)
    next.first = std::max(0, levels.first - 1);
  next.most = std::clamp(levels.most + (forced_ ? -1 : 1), 1, StepLevels::deepest);
  next.first = std::min(next.first, next.most);
  return next;
}

}  // namespace weft
