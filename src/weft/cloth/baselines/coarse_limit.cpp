#include "weft/cloth/baselines/coarse_limit.h"

#include <algorithm>

#include "weft/cloth/baselines/mip_levels.h"
#include "weft/cloth/border_springs.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

/// The springs of the next coarser level: each has the rest length of two springs in line.
SpringPlane joined_springs(const SpringPlane& fine, int n) {
  SpringPlane plane{fine.down, fine.right, Grid<float>(n, n, 1), {}, {}};
  for (int r = 0; r + fine.down < n; ++r)
    for (int c = std::max(0, -fine.right); c + std::max(0, fine.right) < n; ++c)
      plane.rest_length(r, c) =
          fine.rest_length(2 * r, 2 * c) + fine.rest_length(2 * r + fine.down, 2 * c + fine.right);
  return plane;
}

/// One over the number of copies of each particle.
Grid<float> shares_of(const BorderMates& mates) {
  const int n = mates.size();
  Grid<float> shares(n, n, 1);
  for (int index = 0; index < mates.class_count(); ++index)
    for (const int s : mates.mates(index))
      shares(s / n, s % n) = 1 / static_cast<float>(mates.mates(index).size());
  return shares;
}

Grid<float> restricted_masses(const Cloth& fine, const BorderMates& mates) {
  const Grid<float> shares = shares_of(fine.mates);
  std::vector<float> line(static_cast<std::size_t>(fine.size));
  Grid<float> mass(mates.size(), mates.size());
  for (int r = 0; r < mates.size(); ++r)
    restrict_plane_row(fine.mass, &shares, r, line.data(), mass.row(r));
  sum_over_mates(mates, {&mass});
  return mass;
}

/// Adds the corrections of a coarser level, interpolated to a row; none where pinned.
void interpolate(const ClothState& coarse, const Grid<float>& moves, int row, Planes3& out) {
  const Row3 to = row_of(out, row);
  add_interpolated_row(coarse.velocity.x, row, moves.row(row), to.x);
  add_interpolated_row(coarse.velocity.y, row, moves.row(row), to.y);
  add_interpolated_row(coarse.velocity.z, row, moves.row(row), to.z);
}

void add_row(const Planes3& term, float factor, int row, Planes3& sum) {
  const ConstRow3 from = row_of(term, row);
  const Row3 to = row_of(sum, row);
#pragma omp simd
  for (int c = 0; c < term.size(); ++c) {
    to.x[c] += factor * from.x[c];
    to.y[c] += factor * from.y[c];
    to.z[c] += factor * from.z[c];
  }
}

}  // namespace

std::unique_ptr<CoarseLimit::Level> CoarseLimit::coarsened(const Cloth& fine) {
  Cloth coarse;
  coarse.size = (fine.size - 1) / 2 + 1;
  coarse.mates = halves(fine.mates) ? halved(fine.mates) : BorderMates(coarse.size, {});
  coarse.mass = restricted_masses(fine, coarse.mates);
  coarse.inverse_mass = Grid<float>(coarse.size, coarse.size);
  for (int d = 0; d < bend_u; ++d) coarse.springs[d] = joined_springs(fine.springs[d], coarse.size);
  coarse.border_springs = find_border_springs(coarse);
  const int n = coarse.size;
  return std::make_unique<Level>(
      Level{std::move(coarse), {Planes3(n), Planes3(n)}, Grid<float>(n, n, 1)});
}

CoarseLimit::CoarseLimit(const Cloth& cloth, const ThreadTeam& team)
    : cloth_(cloth),
      moves_(cloth.size, cloth.size, 1),
      correction_(cloth.size),
      velocities_(cloth, team) {
  const Cloth* fine = &cloth;
  while (fine->size % 2 == 1 && (fine->size - 1) / 2 + 1 >= min_level_size) {
    levels_.push_back(coarsened(*fine));
    fine = &levels_.back()->cloth;
    levels_.back()->passes = std::make_unique<StrainPasses>(*fine, team);
  }
}

void CoarseLimit::sample(const ClothState& state) {
  const Planes3* position = &state.position;
  const Grid<float>* inverse_mass = &cloth_.inverse_mass;
  for (const auto& held : levels_) {
    Level& level = *held;
    const int n = level.cloth.size;
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) {
        const bool moves = (*inverse_mass)(2 * r, 2 * c) > 0;
        level.moves(r, c) = moves ? 1.0F : 0.0F;
        level.cloth.inverse_mass(r, c) = moves ? 1 / level.cloth.mass(r, c) : 0.0F;
        level.state.position.set(r, c, position->at(2 * r, 2 * c));
      }
    position = &level.state.position;
    inverse_mass = &level.cloth.inverse_mass;
  }
}

/// Limits a level, starting from the interpolated corrections of the coarser one.
void CoarseLimit::limit_level(std::size_t index, int passes, const StrainBounds& bounds,
                              Worker& worker) {
  Level& level = *levels_[index];
  Planes3 &x = level.state.position, &d = level.state.velocity;
  const bool coarsest = index + 1 == levels_.size();
  for (int r = 0; r < level.cloth.size; ++r) {
    clear(row_of(d, r), d.size());
    if (!coarsest) interpolate(levels_[index + 1]->state, level.moves, r, d);
  }
  average_over_mates(level.cloth.mates, worker, {&d.x, &d.y, &d.z});
  for (int r = 0; r < level.cloth.size; ++r) add_row(d, 1, r, x);
  level.passes->run(passes, {0, bounds.longest, 1, bounds.as_printed}, {x, d}, worker);
  copy_to_mates(level.cloth.mates, worker, {&x.x, &x.y, &x.z, &d.x, &d.y, &d.z});
}

/// Interpolates the corrections of the finest of the levels to the cloth. Ends with a barrier.
void CoarseLimit::interpolate_corrections(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    for (int c = 0; c < cloth_.size; ++c)
      moves_(r, c) = cloth_.inverse_mass(r, c) > 0 ? 1.0F : 0.0F;
    clear(row_of(correction_, r), correction_.size());
    interpolate(levels_.front()->state, moves_, r, correction_);
  }
  worker.barrier();
  average_over_mates(cloth_.mates, worker, {&correction_.x, &correction_.y, &correction_.z});
  worker.barrier();
}

void CoarseLimit::apply(const StrainBounds& bounds, ClothState& state, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    add_row(correction_, 1, r, state.position);
    if (bounds.as_printed) add_row(correction_, bounds.inverse_step, r, state.velocity);
  }
  if (!bounds.as_printed) velocities_.add(correction_, bounds.inverse_step, state.velocity, worker);
}

void CoarseLimit::limit(const LimitOptions& options, double time_step, ClothState& state,
                        ThreadTeam& team) noexcept {
  const double limit = strain_limit_of(options, cloth_.material);
  if (levels_.empty() || limit <= 0 || options.passes <= 0) return;
  sample(state);
  const StrainBounds bounds{0, 1 + static_cast<float>(limit), static_cast<float>(1 / time_step),
                            options.as_printed};
  ThreadTeam alone(1);
  alone.run([&](Worker& worker) {
    for (std::size_t i = levels_.size(); i-- > 0;) limit_level(i, options.passes, bounds, worker);
  });
  team.run([&](Worker& worker) {
    interpolate_corrections(worker);
    apply(bounds, state, worker);
  });
}

}  // namespace weft
