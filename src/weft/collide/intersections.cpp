#include "weft/collide/intersections.h"

#include "weft/mesh/crossings.h"

namespace weft {
namespace {

std::vector<Corners> corners_of(const GridTriangles& surface) {
  const auto position = [&](int sample) { return vec_cast<double>(surface.positions->at(sample)); };
  std::vector<Corners> corners;
  corners.reserve(surface.triangles->size());
  for (const auto& [a, b, c] : *surface.triangles)
    corners.push_back({position(a), position(b), position(c)});
  return corners;
}

}  // namespace

int count_intersections(const GridTriangles& a, const GridTriangles& b) {
  return static_cast<int>(count_crossings(corners_of(a), corners_of(b)));
}

}  // namespace weft
