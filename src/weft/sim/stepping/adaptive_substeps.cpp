#include "weft/sim/stepping/adaptive_substeps.h"

#include <algorithm>
#include <cmath>

#include "weft/mesh/box_tree.h"

namespace weft {
namespace {

/// Samples a side of a block.
constexpr int block_size = 16;
/// Levels beyond those that bodies require, to which steps may be halved where points fall back.
constexpr int levels_for_fallen = 3;

Box3d padded(const Box3d& box, double by) {
  const Vec3d aside{by, by, by};
  return {box.lower - aside, box.upper + aside};
}

}  // namespace

ClothReach::ClothReach(int size) {
  const auto blocks = static_cast<std::size_t>((size - 2) / block_size + 1);
  blocks_.reserve(blocks * blocks);
}

void ClothReach::place(const ClothState& cloth, double seconds, double padding) noexcept {
  const int n = cloth.position.size();
  blocks_.clear();
  whole_ = {};
  for (int row = 0; row + 1 < n; row += block_size)
    for (int col = 0; col + 1 < n; col += block_size) {
      Box3d box;
      // Includes the first samples of the next blocks, so that no gap is left between blocks.
      for (int r = row; r <= std::min(n - 1, row + block_size); ++r)
        for (int c = col; c <= std::min(n - 1, col + block_size); ++c) {
          const Vec3d at = vec_cast<double>(cloth.position.at(r, c));
          box.add(at);
          box.add(at + seconds * vec_cast<double>(cloth.velocity.at(r, c)));
        }
      blocks_.push_back(padded(box, padding));
      whole_.add(blocks_.back().lower);
      whole_.add(blocks_.back().upper);
    }
}

bool ClothReach::meets(const Box3d& box) const noexcept {
  return overlap(whole_, box) && std::any_of(blocks_.begin(), blocks_.end(),
                                             [&](const Box3d& b) { return overlap(b, box); });
}

double wanted_subdivisions(const BodyStep& body, const ClothReach& cloth,
                           double max_approach_in_step, SurfaceMotion& motion,
                           ThreadTeam& team) noexcept {
  double wanted = 1;
  if (largest_displacement(body.start, body.end) <= max_approach_in_step) return wanted;
  motion.measure(body.start, body.end, body.triangles, team);
  for (const Triangle& t : body.triangles) {
    double own = 0;
    for (const int corner : t)
      own = std::max(
          {own, motion.approach(corner) / max_approach_in_step, motion.turn(corner) / max_turn});
    if (own <= wanted) continue;
    Box3d way;
    for (const Planes3* at : {&body.start, &body.end})
      for (const int corner : t) way.add(vec_cast<double>(at->at(corner)));
    if (cloth.meets(way)) wanted = own;
  }
  return wanted;
}

int whole_subdivisions(double wanted) noexcept {
  int subdivisions = 1;
  while (subdivisions < max_pieces && subdivisions < wanted) subdivisions *= 2;
  return subdivisions;
}

StepWalk::StepWalk(int least, const StepLevels& levels)
    : least_(least),
      first_(std::max(least, levels.first)),
      level_(first_),
      most_(std::max(first_, levels.most)),
      most_fallen_(std::max(most_, least_ + levels_for_fallen)) {}

void StepWalk::require(int level) {
  least_ = std::max(least_, level);
  first_ = std::max(first_, least_);
  level_ = std::max(level_, first_);
  most_ = std::max(most_, first_);
  most_fallen_ = std::max(most_, least_ + levels_for_fallen);
}

void StepWalk::halve() {
  ++level_;
  halved_ = true;
  calm_ = false;
}

void StepWalk::accept(StepVerdict verdict) {
  done_ += whole >> level_;
  calm_ = calm_ && verdict == StepVerdict::calm;
  if (verdict == StepVerdict::fallen) most_fallen_ = level_;
  if (verdict == StepVerdict::forced || verdict == StepVerdict::fallen) {
    // Halving has not helped: the rest of the substep is halved no further.
    forced_ = true;
    most_ = level_;
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
