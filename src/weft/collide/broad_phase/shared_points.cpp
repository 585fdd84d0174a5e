#include "weft/collide/broad_phase/shared_points.h"

#include <array>

namespace weft {
namespace {

/// The sample of each of two cells that is the one point which they share; -1: they share none, or
/// more.
std::array<int, 2> shared_samples(const SurfaceGrid& grid, const CandidatePair& pair) {
  std::array<int, 2> shared{-1, -1};
  for (const int a : grid.corners(pair.a))
    for (const int b : grid.corners(pair.b)) {
      if (grid.point(a) != grid.point(b)) continue;
      if (shared[0] >= 0) return {-1, -1};
      shared = {a, b};
    }
  return shared;
}

}  // namespace

bool apart_at_shared_point(const MovingSurface& surface, const CandidatePair& pair, float slack) {
  const std::array<int, 2> shared = shared_samples(*surface.grid, pair);
  if (shared[0] < 0) return false;
  const auto from_shared = [&](const Planes3& positions, int side, int sample) {
    return vec_cast<double>(positions.at(sample)) - vec_cast<double>(positions.at(shared[side]));
  };
  const std::array cells{surface.grid->corners(pair.a), surface.grid->corners(pair.b)};
  Vec3d across;
  for (int side = 0; side < 2; ++side)
    for (const int sample : cells[side])
      across += (side == 0 ? 1.0 : -1.0) * from_shared(*surface.start, side, sample);
  const double least = 2.0 * slack * length(across);
  for (int side = 0; side < 2; ++side)
    for (const int sample : cells[side]) {
      if (sample == shared[side]) continue;
      for (const Planes3* positions : {surface.start, surface.end}) {
        const double beyond = dot(across, from_shared(*positions, side, sample));
        if (!((side == 0 ? beyond : -beyond) > least)) return false;
      }
    }
  return true;
}

}  // namespace weft
