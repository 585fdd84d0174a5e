#include "weft/cloth/baselines/filtered_integrator.h"

#include <utility>

#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"
#include "weft/cloth/proposal.h"

namespace weft {

FilteredIntegrator::FilteredIntegrator(const Cloth& cloth, ThreadTeam& team)
    : cloth_(cloth),
      team_(team),
      kernels_(filtering_kernels_for(team.instructions())),
      springs_(cloth, team),
      acceleration_(cloth.size),
      filtered_(cloth.size),
      next_(rest_state(cloth)),
      sums_(cloth.size, team) {}

void FilteredIntegrator::begin(const StepInput& input, const ClothState& state) noexcept {
  const Stopwatch watch;
  input_ = input;
  renew();
  team_.run([&](Worker& worker) { accelerate(state, worker); });
  report_ = {};
  report_.forces_seconds = watch.seconds();
  const Stopwatch filtering;
  team_.run([&](Worker& worker) {
    filter(acceleration_, filtered_, worker);
    advance(state, worker);
  });
  set_pins(cloth_, state, input_.time_step, next_);
  report_.solve_seconds = filtering.seconds();
}

StepReport FilteredIntegrator::end(ClothState& state) noexcept {
  accept(cloth_, next_, state, team_);
  return report_;
}

std::string FilteredIntegrator::caution() const {
  if (cloth_.material.bending == 0) return {};
  return "this integrator filters springs alone: the material's bending counts for nothing, its "
         "bend_springs do";
}

FilteredIntegrator::Corrections FilteredIntegrator::corrections(const Moments& moments,
                                                                double /*time_step*/) const {
  return {momentum_correction(moments), {}};
}

void FilteredIntegrator::average(Planes3& planes, Worker& worker) const {
  if (cloth_.mates.class_count() == 0) return;
  worker.barrier();
  average_over_mates(cloth_.mates, worker, {&planes.x, &planes.y, &planes.z});
  worker.barrier();
}

void FilteredIntegrator::accelerate(const ClothState& state, Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) springs_.gather_row(r, state, acceleration_);
  if (cloth_.mates.class_count() > 0) {
    worker.barrier();
    sum_over_mates(cloth_.mates, worker, {&acceleration_.x, &acceleration_.y, &acceleration_.z});
    worker.barrier();
  }
  for (int r = mine.first; r < mine.last; ++r)
    kernels_.scale(cloth_.size, cloth_.inverse_mass.row(r), row_of(acceleration_, r));
}

void FilteredIntegrator::advance(const ClothState& state, Worker& worker) {
  Corrections add;
  if (cloth_.pins.empty())
    add = corrections(sums_.sum(cloth_, state.position, filtered_, worker), input_.time_step);
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) advance_row(state, add, r);
}

void FilteredIntegrator::advance_row(const ClothState& state, const Corrections& add, int row) {
  const Vec3f centre = vec_cast<float>(add.both.centre), turn = vec_cast<float>(add.both.turn);
  const Vec3f linear = input_.gravity + vec_cast<float>(add.both.linear);
  kernels_.accelerate(cloth_.size,
                      {static_cast<float>(input_.time_step),
                       {linear.x, linear.y, linear.z},
                       {centre.x, centre.y, centre.z},
                       {turn.x, turn.y, turn.z},
                       row_of(state.position, row),
                       row_of(state.velocity, row),
                       row_of(std::as_const(filtered_), row)},
                      row_of(next_.position, row), row_of(next_.velocity, row));
  if (add.position.turn == Vec3d{}) return;
  for (int c = 0; c < cloth_.size; ++c) {
    const Vec3d moved =
        cross(vec_cast<double>(state.position.at(row, c)) - add.position.centre, add.position.turn);
    const double squared_step = input_.time_step * input_.time_step;
    next_.position.set(row, c, next_.position.at(row, c) + vec_cast<float>(squared_step * moved));
  }
}

}  // namespace weft
