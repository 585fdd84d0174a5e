#include "weft/sim/sewing/panels_in_bodies.h"

#include <algorithm>
#include <utility>

#include "weft/sim/sewing/panel_moves.h"

namespace weft {
namespace {

/// Of a panel, before its surface is looked at.
constexpr std::size_t points_asked = 50;

std::vector<Corners> corners_of(std::span<const Triangle> triangles, const Planes3& positions) {
  std::vector<Corners> corners;
  for (const Triangle& t : triangles)
    corners.push_back({vec_cast<double>(positions.at(t[0])), vec_cast<double>(positions.at(t[1])),
                       vec_cast<double>(positions.at(t[2]))});
  return corners;
}

/// The triangles of each chart.
std::vector<std::vector<Triangle>> triangles_by_chart(const GeometryImage& panels) {
  std::vector<std::vector<Triangle>> charts(panels.mates.charts().size());
  for (const Triangle& t : joined_triangles(panels))
    charts[panel_of(panels.mates, t[0])].push_back(t);
  return charts;
}

bool passes_through(std::span<const Triangle> triangles, const Planes3& placed,
                    std::span<const CrossingSurface> skins) {
  if (skins.empty()) return false;
  const CrossingSurface panel(corners_of(triangles, placed));
  return std::any_of(skins.begin(), skins.end(),
                     [&](const CrossingSurface& skin) { return panel.count_crossings(skin) > 0; });
}

}  // namespace

PanelsInBodies::PanelsInBodies(const GeometryImage& panels, std::span<const PlacedBody> bodies,
                               const Planes3& placed)
    : mates_(panels.mates), triangles_(triangles_by_chart(panels)) {
  for (const PlacedBody& body : bodies) {
    ClosedBody closed(body.image, body.positions);
    if (closed.closed() && closed.holds_all(placed)) continue;
    (closed.closed() ? closed_skins_ : open_skins_)
        .emplace_back(corners_of(joined_triangles(body.image), body.positions));
    if (closed.closed()) closed_.push_back(std::move(closed));
  }
}

std::vector<bool> PanelsInBodies::find(const Planes3& placed, ThreadTeam& team) {
  std::vector<bool> found(mates_.charts().size());
  for (const ClosedBody& body : closed_) {
    body.mark_inside(placed, team, inside_);
    for (std::size_t s = 0; s < inside_.size(); ++s)
      if (inside_[s] != 0) found[panel_of(mates_, static_cast<int>(s))] = true;
  }
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!found[i]) found[i] = passes_through(triangles_[i], placed, closed_skins_);
  return found;
}

bool PanelsInBodies::is_free(int panel, const Planes3& placed) const {
  const std::vector<Triangle>& own = triangles_[panel];
  // What passes through no surface is inside as a whole or not at all: one point would do. More
  // find most panels that are not free sooner than crossings do.
  const std::size_t step = std::max<std::size_t>(1, own.size() / points_asked);
  for (std::size_t i = 0; i < own.size(); i += step)
    if (hold(vec_cast<double>(placed.at(own[i][0])))) return false;
  return !passes_through(own, placed, closed_skins_) && !passes_through(own, placed, open_skins_);
}

bool PanelsInBodies::hold(Vec3d point) const {
  return std::any_of(closed_.begin(), closed_.end(),
                     [&](const ClosedBody& body) { return body.holds(point); });
}

}  // namespace weft
