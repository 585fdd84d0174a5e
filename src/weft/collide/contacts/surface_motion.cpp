#include "weft/collide/contacts/surface_motion.h"

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
                            std::span<const Triangle> triangles) {
  points_.assign(static_cast<std::size_t>(start.size()) * start.size(), {});
  for (const Triangle& t : triangles) {
    const Vec3d from = across(start, t), to = across(end, t);
    for (const int corner : t) {
      points_[corner].from += from;
      points_[corner].to += to;
    }
  }
  for (std::size_t s = 0; s < points_.size(); ++s) {
    Point& point = points_[s];
    const int sample = static_cast<int>(s);
    point = {vec_cast<double>(end.at(sample)) - vec_cast<double>(start.at(sample)),
             normalized(point.from), normalized(point.to)};
  }
}

double SurfaceMotion::approach(int sample) const {
  const Point& point = points_[sample];
  return std::abs(dot(0.5 * (point.from + point.to), point.way));
}

double SurfaceMotion::turn(int sample) const {
  return length(points_[sample].to - points_[sample].from);
}

}  // namespace weft
