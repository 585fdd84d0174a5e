#include "weft/collide/contacts/sharp_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "weft/core/math.h"

namespace weft {
namespace {

/// Number of tangential directions in which the surface is probed, each forth and back.
constexpr int ways = 4;

/// Any unit vector across a unit vector.
Vec3d across(Vec3d n) {
  const Vec3d axis = std::abs(n.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  return normalized(cross(n, axis));
}

class SharpnessTest {
 public:
  SharpnessTest(const SurfaceGrid& grid, const BodyQuery& body, const Planes3& positions,
                const Sharpness& sharpness)
      : grid_(grid), body_(body), positions_(positions), sharpness_(sharpness) {}

  [[nodiscard]] bool is_sharp(int point) const {
    if (body_.triangles_around(point).empty()) return false;
    if (on_rim(point)) return true;
    BodyPoint at;
    at.samples = {point, point, point};
    at.weights = {1, 0, 0};
    const Vec3d n = (sharpness_.from_inside ? -1.0 : 1.0) * body_.normal_at(at);
    return stands_out(point, n) || (!body_.closed() && stands_out(point, -n));
  }

 private:
  [[nodiscard]] Vec3d position(int sample) const { return vec_cast<double>(positions_.at(sample)); }
  /// Calls visit(sample) for the other corners of the triangles around a point.
  template <class Visit>
  void for_neighbours(int point, const Visit& visit) const {
    for (const int triangle : body_.triangles_around(point))
      for (const int s : grid_.triangle(triangle / 2, triangle % 2))
        if (grid_.point(s) != point) visit(grid_.point(s));
  }
  /// Whether a point is on the rim, where a neighbour is in one triangle only.
  [[nodiscard]] bool on_rim(int point) const {
    if (body_.closed()) return false;
    bool rim = false;
    for_neighbours(point, [&](int one) {
      int count = 0;
      for_neighbours(point, [&](int other) { count += one == other ? 1 : 0; });
      rim = rim || count == 1;
    });
    return rim;
  }
  [[nodiscard]] bool stands_out(int point, Vec3d n) const {
    return may_fall_back(point, n) && away_on_both_sides(point, n);
  }
  /// Quick test whether the surface may fall back far enough, with the neighbours taken for points
  /// of a cone or of a sphere: it rules most points of a body out.
  [[nodiscard]] bool may_fall_back(int point, Vec3d n) const {
    double max = 0;
    for_neighbours(point, [&](int neighbour) {
      const Vec3d displacement = position(neighbour) - position(point);
      const double back = -dot(n, displacement), beside = length(displacement + back * n);
      if (!(back > 0)) return;
      const double times = beside > 0 ? sharpness_.aside / beside : HUGE_VAL;
      max = std::max(max, back * std::max({1.0, times, times * times}));
    });
    return max > sharpness_.away - sharpness_.gap;
  }
  [[nodiscard]] bool away_on_both_sides(int point, Vec3d n) const {
    const Vec3d u = across(n), v = cross(n, u);
    const Vec3d middle = position(point) + sharpness_.gap * n;
    const auto away = [&](Vec3d p) { return !body_.closest(p, sharpness_.away); };
    for (int i = 0; i < ways; ++i) {
      const double angle = pi * i / ways;
      const Vec3d displacement = sharpness_.aside * (cosine(angle) * u + sine(angle) * v);
      if (away(middle + displacement) && away(middle - displacement)) return true;
    }
    return false;
  }

  const SurfaceGrid& grid_;
  const BodyQuery& body_;
  const Planes3& positions_;
  const Sharpness& sharpness_;
};

}  // namespace

std::vector<int> find_sharp_points(const SurfaceGrid& grid, const BodyQuery& body,
                                   const Planes3& positions, const Sharpness& sharpness) {
  const SharpnessTest test(grid, body, positions, sharpness);
  std::vector<int> found;
  for (int s = 0; s < grid.size() * grid.size(); ++s)
    if (grid.point(s) == s && test.is_sharp(s)) found.push_back(s);
  return found;
}

}  // namespace weft
