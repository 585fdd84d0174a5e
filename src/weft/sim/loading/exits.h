#pragma once

#include <optional>
#include <span>

#include "weft/core/thread_team.h"
#include "weft/simulation.h"

namespace weft {

/// Where a cloth begins so deep in a body that pushing its points out would tear it.
struct TornExit {
  std::size_t body = 0;  ///< number of the body
  double apart = 0;      ///< largest distance of the places where two neighbours leave it [m]
};

/// Finds a body that a cloth would be torn by: every point inside leaves by the closest point of
/// the surface, and along more than 5 % of the cloth's length neighbours would leave farther apart
/// than 10 % of it and than eight times what they are at rest. So it is where cloth passes through
/// the middle of a body. A thin body, as a ring that stands in a sheet, tears little, but ends in a
/// hole all the same: within a part of the cloth that is inside, and has no border, neighbours
/// leave farther apart than half its width (the root of its area) and than four times what they are
/// at rest.
/// @param wrong_side  per sample, the number (from 1) of the body that it begins inside of, or 0
std::optional<TornExit> find_torn_exit(const SimulatedCloth& cloth,
                                       std::span<const PlacedBody> bodies,
                                       std::span<const int> wrong_side, ThreadTeam& team);

}  // namespace weft
