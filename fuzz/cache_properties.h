#pragma once

#include <cmath>

#include "fuzz/properties.h"
#include "weft/point_cache.h"

namespace weft::fuzz {

/// Whole, finite, and at times that ascend from 0.
inline void require_sound(const PointCache& cache) {
  require(cache.points > 0 && cache.samples() > 0, "a cache has points and samples");
  require(cache.positions.size() ==
              static_cast<std::size_t>(cache.points) * static_cast<std::size_t>(cache.samples()),
          "every sample is whole");
  for (const Vec3f p : cache.positions)
    require(std::fabs(p.x) <= 1e30 && std::fabs(p.y) <= 1e30 && std::fabs(p.z) <= 1e30,
            "coordinates are finite");
  require(cache.times[0] == 0, "times begin at 0");
  for (std::size_t k = 1; k < cache.times.size(); ++k)
    require(cache.times[k] > cache.times[k - 1], "times ascend");
}

}  // namespace weft::fuzz
