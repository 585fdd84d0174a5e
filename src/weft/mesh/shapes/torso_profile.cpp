#include "weft/mesh/shapes/torso_profile.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

Section operator+(const Section& a, const Section& b) {
  return {a.height + b.height, a.half_width + b.half_width, a.front + b.front, a.back + b.back};
}
Section operator*(double s, const Section& a) {
  return {s * a.height, s * a.half_width, s * a.front, s * a.back};
}

/// Change per unit of height at section i.
Section slope_at(std::span<const Section> sections, std::size_t i) {
  const Section& before = sections[i == 0 ? 0 : i - 1];
  const Section& after = sections[std::min(i + 1, sections.size() - 1)];
  return (1 / (after.height - before.height)) * (after + -1.0 * before);
}

Section section_at(std::span<const Section> sections, double height) {
  if (height <= sections.front().height) return sections.front();
  if (height >= sections.back().height) return sections.back();
  std::size_t i = 0;
  while (sections[i + 1].height <= height) ++i;
  const double span = sections[i + 1].height - sections[i].height;
  const double t = (height - sections[i].height) / span;
  const double rest = 1 - t;
  return (rest * rest * (1 + 2 * t)) * sections[i] + (t * t * (1 + 2 * rest)) * sections[i + 1] +
         (span * t * rest * rest) * slope_at(sections, i) +
         (-span * t * t * rest) * slope_at(sections, i + 1);
}

}  // namespace

double distance_to_sections(std::span<const Section> sections, Vec3d point) {
  const Section s = section_at(sections, point.y);
  const double depth = 0.5 * (s.front - s.back);
  const double x = point.x / s.half_width, z = (point.z - 0.5 * (s.front + s.back)) / depth;
  const double level = std::sqrt(x * x + z * z);
  const double slope = std::sqrt(x * x / (s.half_width * s.half_width) + z * z / (depth * depth));
  return slope > 0 ? level * (level - 1) / slope : -std::min(s.half_width, depth);
}

}  // namespace weft
