#include "weft/sim/motion/attachments.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh/distance.h"

namespace weft {
namespace {

using Corners = std::array<Vec3d, 3>;

Corners corners_of(const Planes3& positions, const Triangle& triangle) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = vec_cast<double>(positions.at(triangle[k]));
  return corners;
}

/// Orthonormal axes of a triangle: along its first edge, across it, and its normal.
std::array<Vec3d, 3> axes_of(const Corners& t) {
  const Vec3d along = normalized(t[1] - t[0]);
  const Vec3d normal = normalized(cross(t[1] - t[0], t[2] - t[0]));
  return {along, cross(normal, along), normal};
}

Vec3d blend(const std::array<double, 3>& weights, const Corners& t) {
  return weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
}

/// Barycentric coordinates of a point in the plane of a triangle.
std::array<double, 3> weights_at(Vec3d point, const Corners& t) {
  const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
  const double area = dot(normal, normal);
  const double second = dot(normal, cross(t[2] - point, t[0] - point)) / area;
  const double third = dot(normal, cross(t[0] - point, t[1] - point)) / area;
  return {1 - second - third, second, third};
}

/// Finds the nearest triangle of a body, among those that have an area: others have no axes.
class Ties {
 public:
  explicit Ties(const TiedSurface& surface) : positions_(*surface.positions) {
    TriangleMesh mesh;
    const int n = positions_.size();
    for (int s = 0; s < n * n; ++s) mesh.positions.push_back(vec_cast<double>(positions_.at(s)));
    for (const Triangle& t : surface.triangles) {
      const Corners c = corners_of(positions_, t);
      if (squared_length(cross(c[1] - c[0], c[2] - c[0])) > 0) mesh.triangles.push_back(t);
    }
    triangles_ = mesh.triangles;
    if (!triangles_.empty()) query_.emplace(mesh);
  }

  /// Whether there is anything to tie to.
  [[nodiscard]] bool any() const { return query_.has_value(); }
  /// @pre any()
  [[nodiscard]] TiedPlace tie(Vec3d place) const {
    const ClosestPoint closest = query_->closest(place);
    TiedPlace tied;
    tied.triangle = triangles_[static_cast<std::size_t>(closest.triangle)];
    const Corners corners = corners_of(positions_, tied.triangle);
    tied.weights = weights_at(closest.position, corners);
    const std::array<Vec3d, 3> axes = axes_of(corners);
    const Vec3d away = place - blend(tied.weights, corners);
    tied.offset = {dot(axes[0], away), dot(axes[1], away), dot(axes[2], away)};
    return tied;
  }

 private:
  const Planes3& positions_;
  std::vector<Triangle> triangles_;
  std::optional<ClosestPointQuery> query_;
};

int index_of(std::span<const TiedSurface> bodies, const std::string& name) {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == name) return static_cast<int>(i);
  throw SceneError("attach", fmt::format("no body is called '{}'", name),
                   "the name of a body is wanted");
}

}  // namespace

std::vector<std::optional<TiedPlace>> tie_to_nearest(std::span<const Vec3d> places,
                                                     std::span<const TiedSurface> bodies) {
  std::vector<std::optional<TiedPlace>> nearest(places.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Ties ties(bodies[b]);
    for (std::size_t i = 0; ties.any() && i < places.size(); ++i) {
      TiedPlace tied = ties.tie(places[i]);
      tied.body = static_cast<int>(b);
      if (!nearest[i] || length(tied.offset) < length(nearest[i]->offset)) nearest[i] = tied;
    }
  }
  return nearest;
}

Vec3d tied_place(const TiedPlace& tied, const Planes3& body) {
  const Corners corners = corners_of(body, tied.triangle);
  const std::array<Vec3d, 3> axes = axes_of(corners);
  return blend(tied.weights, corners) + tied.offset.x * axes[0] + tied.offset.y * axes[1] +
         tied.offset.z * axes[2];
}

std::vector<TiedPin> tie_places(Cloth& cloth, std::span<const SceneAttachment> places,
                                std::span<const TiedSurface> bodies,
                                std::vector<PinMotion>& motions) {
  std::vector<TiedPin> all;
  for (const SceneAttachment& place : places) {
    const std::vector<int> held = pin_place(cloth, place.place);
    let_go(held, motions);
    std::erase_if(all, [&](const TiedPin& tied) {
      return std::binary_search(held.begin(), held.end(), tied.pin);
    });
    const int body = index_of(bodies, place.body);
    const Ties ties(bodies[static_cast<std::size_t>(body)]);
    if (!ties.any())
      throw SceneError("attach", fmt::format("body '{}' has no area", place.body),
                       "a body with some is wanted");
    for (const int pin : held) {
      TiedPlace tied = ties.tie(cloth.pins[static_cast<std::size_t>(pin)].target);
      tied.body = body;
      all.push_back({tied, pin});
    }
  }
  return all;
}

void move_tied(std::span<const TiedPin> tied, std::span<const Planes3* const> bodies,
               Cloth& cloth) {
  for (const TiedPin& tie : tied) {
    const Planes3* body = bodies[static_cast<std::size_t>(tie.body)];
    if (body == nullptr) continue;
    cloth.pins[static_cast<std::size_t>(tie.pin)].target = tied_place(tie, *body);
  }
}

}  // namespace weft
