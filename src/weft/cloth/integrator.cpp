#include "weft/cloth/integrator.h"

#include <algorithm>

#include "weft/cloth/mates.h"

namespace weft {
namespace {

void copy_row(const Grid<float>& from, Grid<float>& to, int row) {
  std::copy(from.row(row), from.row(row) + from.cols(), to.row(row));
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& options, const Cloth& cloth,
                                            const StepInput& typical, ThreadTeam& team) {
  return std::visit(
      [&](const auto& chosen) { return make_integrator_of(chosen, cloth, typical, team); },
      options);
}

void copy_rows(const ClothState& from, ClothState& to, Worker& worker) {
  const Range mine = worker.share(from.position.size());
  for (int r = mine.first; r < mine.last; ++r) {
    copy_row(from.position.x, to.position.x, r);
    copy_row(from.position.y, to.position.y, r);
    copy_row(from.position.z, to.position.z, r);
    copy_row(from.velocity.x, to.velocity.x, r);
    copy_row(from.velocity.y, to.velocity.y, r);
    copy_row(from.velocity.z, to.velocity.z, r);
  }
}

namespace {

/// Where a pin takes a copy of its class in a step. Of one that is still to be sewn to the held
/// sample: along with it, and towards it as its velocity says.
Vec3d pinned_place(const Cloth& cloth, const Pin& held, int copy, const ClothState& start,
                   double time_step) {
  if (cloth.is_held_at(held, copy)) return held.target;
  const auto place = [&](int s) { return vec_cast<double>(start.position.at(s)); };
  const Vec3d sewn =
      vec_cast<double>(start.velocity.at(copy)) - vec_cast<double>(start.velocity.at(held.sample));
  return place(copy) + (held.target - place(held.sample)) + time_step * sewn;
}

}  // namespace

void set_pins(const Cloth& cloth, const ClothState& start, double time_step, ClothState& next) {
  for (const Pin& held : cloth.pins)
    for (const int sample : held.copies) {
      const Vec3d place = pinned_place(cloth, held, sample, start, time_step);
      const Vec3d displacement = place - vec_cast<double>(start.position.at(sample));
      next.position.set(sample, vec_cast<float>(place));
      next.velocity.set(sample, vec_cast<float>((1 / time_step) * displacement));
    }
}

void accept(const Cloth& cloth, ClothState& next, ClothState& state, ThreadTeam& team) {
  team.run([&](Worker& worker) {
    copy_to_mates(cloth.together(), worker,
                  {&next.position.x, &next.position.y, &next.position.z, &next.velocity.x,
                   &next.velocity.y, &next.velocity.z});
    worker.barrier();
    copy_rows(next, state, worker);
  });
}

}  // namespace weft
