#include "weft/run/verification.h"

#include <algorithm>

#include "weft/cloth/cloth.h"

namespace weft {
namespace {

template <class Things, class Positions>
std::vector<PassingCheck::Surface> surfaces_of(const Things& things, const Positions& positions) {
  std::vector<PassingCheck::Surface> surfaces;
  for (const auto& thing : things) {
    surfaces.push_back({&thing.image, &positions(thing)});
    if constexpr (requires { thing.garment; })
      if (thing.garment) surfaces.back().sewn = &thing.garment->sewn;
    if constexpr (requires { thing.buried; }) surfaces.back().buried = &thing.buried;
  }
  return surfaces;
}

const Planes3& cloth_positions(const SimulatedCloth& cloth) { return cloth.state.position; }
const Planes3& body_positions(const PlacedBody& body) { return body.positions; }

}  // namespace

Verifier::Verifier(const Simulation& simulation, std::optional<double> ground)
    : simulation_(simulation),
      passings_(surfaces_of(simulation.cloths(), cloth_positions),
                surfaces_of(simulation.bodies(), body_positions), ground) {
  for (std::size_t i = 0; i < simulation.cloths().size(); ++i)
    for (const PlacedBody& placed : simulation.bodies()) {
      ClosedBody body(placed.image, placed.positions);
      if (!body.closed()) continue;
      body.mark_inside(simulation.cloths()[i].state.position, alone_, inside_);
      const bool kept_in =
          std::all_of(inside_.begin(), inside_.end(), [](char inside) { return inside != 0; });
      sides_.push_back({i, std::move(body), kept_in, std::vector<char>(inside_.size(), 0)});
    }
  begin();
}

std::int64_t Verifier::count_swallowed() {
  std::int64_t count = 0;
  for (Sides& sides : sides_) {
    const SimulatedCloth& cloth = simulation_.cloths()[sides.cloth];
    sides.body.follow();
    sides.body.mark_inside(cloth.state.position, alone_, inside_);
    const int n = cloth.model->size;
    for (int s = 0; s < n * n; ++s) {
      // Where a body lies in itself, cloth between its sides is inside of both.
      const bool right = (inside_[s] != 0) == sides.kept_in || inside_[s] > 1;
      count += !right && sides.right[s] != 0 && cloth.model->owner(s / n, s % n) > 0 ? 1 : 0;
      if (right) sides.right[s] = 1;
    }
  }
  return count;
}

void Verifier::count_frame(int frame, Verification& found) {
  found.passed.add(frame, passed_);
  passed_ = 0;
  found.swallowed.add(frame, count_swallowed());
}

}  // namespace weft
