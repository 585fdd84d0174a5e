#include "weft/sim/sewing/free_height.h"

#include <algorithm>
#include <vector>

#include "weft/sim/loading/insides.h"

namespace weft {
namespace {

/// Heights that are tried, above and below, up to this many. [m]
constexpr double height_step = 0.01;
constexpr int max_steps = 10;

/// The ways of the samples of seams to where they meet.
class WaysToMeet {
 public:
  WaysToMeet(const Garment& garment, const Planes3& placed) {
    for (int k = 0; k < garment.sewn.class_count(); ++k) {
      const std::span<const int> samples = garment.sewn.copies(k);
      Vec3d middle;
      for (const int s : samples)
        middle += (1 / static_cast<double>(samples.size())) * vec_cast<double>(placed.at(s));
      std::vector<Vec3d>& points = of_class_.emplace_back();
      for (const int s : samples) add(vec_cast<double>(placed.at(s)), middle, points);
    }
  }
  /// How many classes have a body in their way. @param up  by how much all begin higher [m]
  [[nodiscard]] int count_blocked(std::span<const ClosedBody> bodies, double up) const {
    const auto is_inside = [&](Vec3d p) {
      return std::any_of(bodies.begin(), bodies.end(), [&](const ClosedBody& body) {
        return body.holds(p + Vec3d{0, up, 0});
      });
    };
    return static_cast<int>(
        std::count_if(of_class_.begin(), of_class_.end(), [&](const std::vector<Vec3d>& points) {
          return std::any_of(points.begin(), points.end(), is_inside);
        }));
  }

 private:
  static void add(Vec3d from, Vec3d to, std::vector<Vec3d>& points) {
    for (const double part : {0.25, 0.5, 0.75, 1.0}) points.push_back(from + part * (to - from));
  }

  std::vector<std::vector<Vec3d>> of_class_;
};

/// The bodies that a garment closes round: rooms that hold all of it are none.
std::vector<ClosedBody> worn_by(std::span<const PlacedBody> bodies, const Planes3& placed) {
  std::vector<ClosedBody> closed;
  for (const PlacedBody& body : bodies) {
    closed.emplace_back(body.image, body.positions);
    if (!closed.back().closed() || closed.back().holds_all(placed)) closed.pop_back();
  }
  return closed;
}

/// The nearest height at which half as many seams are blocked, or less.
double free_height(const WaysToMeet& ways, std::span<const ClosedBody> bodies) {
  const int first = ways.count_blocked(bodies, 0);
  if (first == 0) return 0;
  for (int i = 1; i <= max_steps; ++i)
    for (const double up : {height_step * i, -height_step * i})
      if (2 * ways.count_blocked(bodies, up) <= first) return up;
  return 0;
}

}  // namespace

double move_to_free_height(const Garment& garment, std::span<const PlacedBody> bodies,
                           Planes3& placed) {
  const double height = free_height(WaysToMeet(garment, placed), worn_by(bodies, placed));
  for (int s = 0; height != 0 && s < placed.size() * placed.size(); ++s)
    placed.set(s, placed.at(s) + Vec3f{0, static_cast<float>(height), 0});
  return height;
}

}  // namespace weft
