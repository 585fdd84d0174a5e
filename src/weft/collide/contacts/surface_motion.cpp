#include "weft/collide/contacts/surface_motion.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Twice a triangle's area along its normal.
Vec3d across(const Planes3& at, const Triangle& t) {
  const Vec3d a = vec_cast<double>(at.at(t[0]));
  return cross(vec_cast<double>(at.at(t[1])) - a, vec_cast<double>(at.at(t[2])) - a);
}

}  // namespace

void SurfaceMotion::measure(const Planes3& start, const Planes3& end,
                            std::span<const Triangle> triangles, ThreadTeam& team) {
  const int samples = start.size() * start.size();
  triangles_.resize(triangles.size());
  points_.resize(static_cast<std::size_t>(samples));
  team.run([&](Worker& worker) {
    const Range mine = worker.share(static_cast<int>(triangles.size()));
    for (int t = mine.first; t < mine.last; ++t) {
      const Vec3d from = across(start, triangles[t]);
      triangles_[t] = {from, across(end, triangles[t]), length(from)};
    }
  });
  sums_.assign(static_cast<std::size_t>(samples), {});
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const int corner : triangles[t]) {
      sums_[corner].from += triangles_[t].from;
      sums_[corner].to += triangles_[t].to;
      sums_[corner].size += triangles_[t].size;
    }
  team.run([&](Worker& worker) {
    const Range mine = worker.share(samples);
    for (int s = mine.first; s < mine.last; ++s) {
      const Vec3d from = normalized(sums_[s].from), to = normalized(sums_[s].to);
      Point& point = points_[s];
      point.displacement = vec_cast<double>(end.at(s)) - vec_cast<double>(start.at(s));
      point.normal = 0.5 * (from + to);
      point.approach = std::abs(dot(point.normal, point.displacement));
      point.turn = length(to - from);
      // The more the triangles tilt, the shorter the sum of their area vectors.
      const double lost = sums_[s].size > 0 ? 1 - length(sums_[s].from) / sums_[s].size : 0;
      point.slant = 2 * std::sqrt(2 * std::max(0.0, lost));
    }
  });
}

double SurfaceMotion::approach(int sample, Vec3d displacement) const {
  const Point& point = points_[sample];
  const Vec3d left = point.displacement - displacement;
  return std::abs(dot(point.normal, left)) + point.slant * length(left);
}

}  // namespace weft
