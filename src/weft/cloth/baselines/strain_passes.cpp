#include "weft/cloth/baselines/strain_passes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "weft/cloth/neighbours.h"

// Springs are limited in eight colours: each of the four directions in two, such that no two
// springs of a colour share a particle. With mates, springs that have an end on the border join
// classes in ways that this colouring does not cover. They are few: one worker limits them in
// order, on the representatives, after the colours of a pass.

namespace weft {
namespace {

/// Passes over fewer samples are left to one worker: barriers would cost more.
constexpr int samples_worth_sharing = 4096;
constexpr int min_block = 32, max_blocks = 64;
/// Over-relaxation of the corrections as printed, from the second pass on: the first one leaves
/// single springs at their limit.
constexpr float over_relaxation = 1.75F;

int block_size(int n) {
  const int wanted = (n + max_blocks - 1) / max_blocks;
  return (wanted + min_block - 1) / min_block * min_block;
}

std::uint64_t bits(int first, int last) {
  const std::uint64_t below_last = last >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << last) - 1;
  return below_last & ~((std::uint64_t{1} << first) - 1);
}

/// How far the first end of a spring moves along its vector per unit of its inverse mass.
float correction(float squared, float rest, float inverse_masses, const StrainBounds& bounds) {
  const float low = rest * bounds.shortest, high = rest * bounds.longest;
  if (squared >= low * low && squared <= high * high) return 0;
  if (!(squared > 0 && inverse_masses > 0)) return 0;
  const float length = std::sqrt(squared);
  const float wanted = length > high ? high : (length < low ? low : length);
  return (length - wanted) / (length * inverse_masses);
}

}  // namespace

struct StrainPasses::Sweep {
  const StrainBounds& bounds;
  const LimitedMotion& motion;
  Worker& worker;
  bool alone;
  float relaxation;

  [[nodiscard]] Range share(int count) const {
    return alone ? Range{0, count} : worker.share(count);
  }
  void barrier() const {
    if (!alone) worker.barrier();
  }
};

StrainPasses::StrainPasses(const Cloth& cloth, const ThreadTeam& team)
    : cloth_(cloth),
      kernels_(&kernels_for(team.instructions())),
      first_(cloth.mates.class_count() > 0 ? 1 : 0),
      block_(block_size(cloth.size)),
      active_(static_cast<std::size_t>(cloth.size)),
      changed_(static_cast<std::size_t>(cloth.size)) {}

LimitedRows StrainPasses::join(const Sweep& sweep, const SpringPlane& springs, int row) const {
  const int other = row + springs.down;
  const LimitedMotion& motion = sweep.motion;
  return {row_of(motion.position, row),
          row_of(motion.position, other),
          row_of(motion.change, row),
          row_of(motion.change, other),
          cloth_.inverse_mass.row(row),
          cloth_.inverse_mass.row(other),
          springs.rest_length.row(row),
          springs.right,
          first_ + std::max(0, -springs.right),
          cloth_.size - first_ - std::max(0, springs.right),
          1,
          sweep.bounds.shortest,
          sweep.bounds.longest,
          sweep.bounds.inverse_step,
          sweep.relaxation};
}

Range StrainPasses::columns_of(int first_block, int last_block) const {
  return {first_block * block_, std::min(cloth_.size, last_block * block_)};
}

/// Limits the springs that start from a run of blocks.
void StrainPasses::limit_run(LimitedRows rows, Range blocks, int row) {
  const LimitedRows whole = rows;
  const auto cut_to = [&](Range columns) {
    const int skipped = std::max(0, columns.first - whole.first);
    rows.first = whole.first + (skipped + whole.step - 1) / whole.step * whole.step;
    rows.last = std::min(whole.last, columns.last);
    return rows.first < rows.last && kernels_->breaks_limit(rows);
  };
  if (!cut_to(columns_of(blocks.first, blocks.last))) return;
  for (int b = blocks.first; b < blocks.last; ++b) {
    if (!cut_to(columns_of(b, b + 1))) continue;
    kernels_->limit(rows);
    changed_[row] |= bits(b, b + 1);
  }
}

/// Limits one colour: springs along rows by column parity, others by row parity.
void StrainPasses::limit_colour(const Sweep& sweep, int direction, int parity) {
  const SpringPlane& springs = cloth_.springs[direction];
  const int rows = cloth_.size - 2 * first_ - springs.down;
  const bool by_column = springs.down == 0;
  const Range mine = sweep.share(by_column ? rows : (rows + 1 - parity) / 2);
  const int blocks = (cloth_.size + block_ - 1) / block_;
  for (int i = mine.first; i < mine.last; ++i) {
    const int row = first_ + (by_column ? i : 2 * i + parity);
    if (active_[row] == 0) continue;
    LimitedRows joined = join(sweep, springs, row);
    if (by_column) {
      joined.first += parity;
      joined.step = 2;
    }
    for (int b = 0; b < blocks;) {
      int end = b;
      while (end < blocks && (active_[row] >> end & 1U) != 0) ++end;
      if (end > b) limit_run(joined, {b, end}, row);
      b = end + 1;
    }
  }
}

void StrainPasses::limit_border(const Sweep& sweep) {
  const int n = cloth_.size;
  const float per_step = sweep.bounds.inverse_step;
  Planes3 &x = sweep.motion.position, &v = sweep.motion.change;
  for (const BorderSpring& spring : cloth_.border_springs) {
    if (!spring.stretch && !sweep.bounds.as_printed) continue;
    const int i = spring.from, j = spring.to;
    const float wi = cloth_.inverse_mass(i / n, i % n), wj = cloth_.inverse_mass(j / n, j % n);
    const Vec3f d = x.at(j) - x.at(i);
    const float s =
        sweep.relaxation * correction(dot(d, d), spring.rest_length, wi + wj, sweep.bounds);
    if (s == 0) continue;
    x.set(i, x.at(i) + s * wi * d);
    x.set(j, x.at(j) - s * wj * d);
    v.set(i, v.at(i) + s * wi * per_step * d);
    v.set(j, v.at(j) - s * wj * per_step * d);
    for (const int sample : {i, j})
      changed_[sample / n] |= bits(sample % n / block_, sample % n / block_ + 1);
  }
}

void StrainPasses::pass(const Sweep& sweep) {
  const int directions = sweep.bounds.as_printed ? bend_u : shear_1;
  for (int direction = stretch_u; direction < directions; ++direction)
    for (const int parity : {0, 1}) {
      limit_colour(sweep, direction, parity);
      sweep.barrier();
    }
  if (first_ > 0 && (sweep.alone || sweep.worker.rank() == 0)) limit_border(sweep);
}

int StrainPasses::changed_blocks() const {
  int count = 0;
  for (const std::uint64_t row : changed_) count += std::popcount(row);
  return count;
}

/// Activates the blocks that the last pass changed, and those beside them, whose springs may now be
/// out of bounds.
void StrainPasses::renew_active() {
  const int n = cloth_.size;
  for (int r = 0; r < n; ++r) {
    const std::uint64_t near =
        changed_[r] | (r > 0 ? changed_[r - 1] : 0) | (r + 1 < n ? changed_[r + 1] : 0);
    active_[r] = near | near << 1U | near >> 1U;
  }
  std::fill(changed_.begin(), changed_.end(), 0);
}

bool StrainPasses::run(int count, const StrainBounds& bounds, const LimitedMotion& motion,
                       Worker& worker) noexcept {
  if (worker.rank() == 0) {
    std::fill(active_.begin(), active_.end(), ~std::uint64_t{0});
    std::fill(changed_.begin(), changed_.end(), 0);
  }
  worker.barrier();
  bool alone = false;
  for (int i = 0; i < count; ++i) {
    const float relaxation = bounds.as_printed && i > 0 ? over_relaxation : 1.0F;
    if (!alone || worker.rank() == 0) pass({bounds, motion, worker, alone, relaxation});
    worker.barrier();
    const int changed = changed_blocks();
    alone = changed * block_ < samples_worth_sharing;
    worker.barrier();
    if (changed == 0) return i > 0;
    if (worker.rank() == 0) renew_active();
    worker.barrier();
  }
  return count > 0;
}

}  // namespace weft
