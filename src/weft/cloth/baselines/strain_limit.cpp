#include "weft/cloth/baselines/strain_limit.h"

#include <algorithm>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {

namespace {

/// The factor f of SafeVelocities. @param linear, squared  b and 2 a of the change
double safe_part(double linear, double squared) {
  return squared > 0 ? std::clamp(-2 * linear / squared, 0.0, 1.0) : 0;
}

void add_row(ConstRow3 from, float factor, int n, Row3 to) {
  for (int c = 0; c < n; ++c) {
    to.x[c] += factor * from.x[c];
    to.y[c] += factor * from.y[c];
    to.z[c] += factor * from.z[c];
  }
}

}  // namespace

SafeVelocities::SafeVelocities(const Cloth& cloth, const ThreadTeam& team)
    : cloth_(cloth),
      kernels_(kernels_for(team.instructions())),
      own_mass_(cloth.size, cloth.size),
      sums_(cloth.size) {
  for (int r = 0; r < cloth.size; ++r)
    for (int c = 0; c < cloth.size; ++c) own_mass_(r, c) = cloth.mass(r, c) * cloth.owner(r, c);
}

double SafeVelocities::add(const Planes3& change, double scale, Planes3& velocity, Worker& worker) {
  const int n = cloth_.size;
  const auto product = [&](const Planes3& other) {
    return sums_.sum(worker, [&](int row) {
      return kernels_.dot(n, own_mass_.row(row), row_of(change, row), row_of(other, row));
    });
  };
  const double linear = scale * product(velocity);
  const double part = safe_part(linear, scale * scale * product(change));
  // The sums end with a barrier: no worker reads velocities any more.
  const Range mine = worker.share(n);
  for (int row = mine.first; part > 0 && row < mine.last; ++row)
    add_row(row_of(change, row), static_cast<float>(part * scale), n, row_of(velocity, row));
  return part;
}

namespace {

/// Fraction of the limit that corrections aim at, so that rounding and the last pass leave no
/// spring beyond it.
constexpr float margin = 0.985F;

}  // namespace

StrainLimit::StrainLimit(const Cloth& cloth, const ThreadTeam& team)
    : cloth_(cloth), passes_(cloth, team), velocities_(cloth, team), correction_(cloth.size) {}

double strain_limit_of(const LimitOptions& options, const Material& material) {
  return options.strain > 0 ? options.strain : material.strain_limit;
}

/// Limits positions and adds the safe part of the corrections to the velocities.
void StrainLimit::limit_safely(int passes, const StrainBounds& bounds, ClothState& state,
                               Worker& worker) {
  if (!passes_.run(passes, {0, bounds.longest}, {state.position, correction_}, worker)) return;
  velocities_.add(correction_, bounds.inverse_step, state.velocity, worker);
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    for (Grid<float>* plane : {&correction_.x, &correction_.y, &correction_.z})
      std::fill(plane->row(r), plane->row(r) + cloth_.size, 0.0F);
  worker.barrier();
}

void StrainLimit::limit(const LimitOptions& options, double time_step, ClothState& state,
                        ThreadTeam& team) noexcept {
  const double limit = strain_limit_of(options, cloth_.material);
  if (limit <= 0 || options.passes <= 0) return;
  const auto elongation = margin * static_cast<float>(limit);
  const StrainBounds bounds{1 - elongation, 1 + elongation, static_cast<float>(1 / time_step),
                            options.as_printed};
  team.run([&](Worker& worker) {
    if (options.as_printed)
      passes_.run(options.passes, bounds, {state.position, state.velocity}, worker);
    else
      limit_safely(options.passes, bounds, state, worker);
    copy_to_mates(cloth_.mates, worker,
                  {&state.position.x, &state.position.y, &state.position.z, &state.velocity.x,
                   &state.velocity.y, &state.velocity.z});
  });
}

void limit_strain(const Cloth& cloth, const LimitOptions& options, double time_step,
                  ClothState& state, ThreadTeam& team) {
  StrainLimit(cloth, team).limit(options, time_step, state, team);
}

}  // namespace weft
