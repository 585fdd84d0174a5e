#include "weft/sim/loading/insides.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/cloth/cloth.h"
#include "weft/geometry_image.h"

namespace weft {
namespace {

bool is_in(const Box3d& box, Vec3d p) {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y &&
         box.lower.z <= p.z && p.z <= box.upper.z;
}

int count_particles(const SimulatedCloth& cloth, const std::vector<char>& marked) {
  int count = 0;
  const int n = cloth.model->size;
  for (int s = 0; s < n * n; ++s)
    count += marked[static_cast<std::size_t>(s)] != 0 && cloth.model->owner(s / n, s % n) > 0;
  return count;
}

}  // namespace

std::vector<Triangle> joined_triangles(const GeometryImage& image) {
  std::vector<Triangle> joined;
  for (Triangle t : grid_triangles(image)) {
    if (image.mates.size() > 0)
      for (int& corner : t) corner = image.mates.representative(corner);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) joined.push_back(t);
  }
  return joined;
}

ClosedBody::ClosedBody(const GeometryImage& image, const Planes3& positions)
    : positions_(&positions), triangles_(joined_triangles(image)) {
  if (!is_closed(triangles_)) return;
  std::vector<Corners> corners(triangles_.size());
  put_corners(corners);
  winding_.emplace(std::move(corners));
  follow();
}

void ClosedBody::put_corners(std::span<Corners> corners) const {
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      corners[t][k] = vec_cast<double>(positions_->at(triangles_[t][k]));
}

void ClosedBody::follow() {
  put_corners(winding_->triangles());
  winding_->moved();
  box_ = {};
  for (const Corners& t : winding_->triangles())
    for (const Vec3d corner : t) box_.add(corner);
}

int ClosedBody::depth(Vec3d point, Vec3d towards) const {
  return is_in(box_, point) ? std::abs(winding_->at(point, towards)) : 0;
}

bool ClosedBody::holds_all(const Planes3& samples) const {
  for (int s = 0; s < samples.size() * samples.size(); ++s)
    if (!holds(vec_cast<double>(samples.at(s)))) return false;
  return true;
}

void ClosedBody::mark_inside(const Planes3& samples, ThreadTeam& team,
                             std::vector<char>& inside) const {
  const int count = samples.size() * samples.size();
  inside.resize(static_cast<std::size_t>(count));
  team.run([&](Worker& worker) {
    const Range mine = worker.share(count);
    for (int s = mine.first; s < mine.last; ++s) {
      inside[static_cast<std::size_t>(s)] =
          static_cast<char>(std::min(2, depth(vec_cast<double>(samples.at(s)))));
    }
  });
}

StartSides find_start_sides(const SimulatedCloth& cloth, std::span<const PlacedBody> bodies,
                            bool containers, ThreadTeam& team) {
  const int n = cloth.model->size;
  StartSides sides{{},
                   std::vector<char>(bodies.size(), 0),
                   std::vector<int>(static_cast<std::size_t>(n) * n, 0)};
  std::vector<char> inside;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const ClosedBody body(bodies[b].image, bodies[b].positions);
    if (!body.closed()) continue;
    body.mark_inside(cloth.state.position, team, inside);
    const int count = count_particles(cloth, inside);
    if (count == 0) continue;
    const bool kept_in = containers && count == cloth.model->particles;
    sides.inside.push_back({cloth.name, bodies[b].name, count, cloth.model->particles, kept_in});
    sides.kept_in[b] = kept_in ? 1 : 0;
    for (std::size_t s = 0; s < inside.size() && !kept_in; ++s)
      if (inside[s] != 0) sides.wrong_side[s] = static_cast<int>(b) + 1;
  }
  return sides;
}

std::string start_inside_text(const StartInside& found) {
  if (found.kept_in)
    return fmt::format("cloth '{}' begins inside of body '{}', which keeps it in", found.cloth,
                       found.body);
  return fmt::format(
      "cloth '{}' begins with {} of {} points inside of body '{}', which pushes "
      "them out",
      found.cloth, found.samples, found.particles, found.body);
}

}  // namespace weft
