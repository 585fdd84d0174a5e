#include "weft/collide/contacts/corner_contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "weft/collide/contacts/closest.h"
#include "weft/collide/contacts/sharp_points.h"

namespace weft {
namespace {

/// A triangle's samples are about this many rest spacings from a point that its inside touches.
constexpr double aside_in_spacings = 0.5;
/// Samples farther than this many gaps from a surface have no contact with it.
constexpr double away_in_gaps = 1.5;
/// Weight of one sample above which that sample's own contact serves.
constexpr double nearly_all = 0.99;

using Corners = std::array<Vec3d, 3>;

std::array<int, 2> in_order(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

PathBox path_of(Vec3f start, Vec3f end) {
  return {{start.x, start.y, start.z},
          {start.x, start.y, start.z},
          {end.x, end.y, end.z},
          {end.x, end.y, end.z}};
}

/// Box of the paths of points of a body.
PathBox path_of(const ContactBody& body, std::span<const int> points) {
  PathBox box = path_of(body.start->at(points[0]), body.end->at(points[0]));
  for (const int point : points.subspan(1)) {
    const PathBox one = path_of(body.start->at(point), body.end->at(point));
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower_start[k] = std::min(box.lower_start[k], one.lower_start[k]);
      box.upper_start[k] = std::max(box.upper_start[k], one.upper_start[k]);
      box.lower_end[k] = std::min(box.lower_end[k], one.lower_end[k]);
      box.upper_end[k] = std::max(box.upper_end[k], one.upper_end[k]);
    }
  }
  return box;
}

/// A side of the squares of samples by which sharp points are searched together.
constexpr int square_side = 8;

/// The square that a sample lies in; squares are numbered row by row.
int tile_of(int sample, int size) {
  const int across = (size + square_side - 1) / square_side;
  return sample / size / square_side * across + sample % size / square_side;
}

/// Calls visit(node) for the cells reached from a node by the children that near(node) marks.
template <class Near, class Visit>
void for_near_cells(const Node& node, const Near& near, const Visit& visit) {
  if (node.level == 0) return visit(node);
  const unsigned marked = near(node);
  for (int k = 0; k < 4; ++k)
    if ((marked >> k & 1U) != 0)
      for_near_cells({node.level - 1, 2 * node.row + k / 2, 2 * node.col + k % 2}, near, visit);
}

}  // namespace

CornerContacts::CornerContacts(const SurfaceGrid& grid, const CollidingCloth& cloth)
    : grid_(grid),
      kept_{cloth.thickness, cloth.friction},
      spacing_(cloth.rest_spacing),
      kept_in_(cloth.kept_in) {}

void CornerContacts::add_body(const SurfaceGrid& grid, const BodyQuery& body,
                              const Planes3& shape) {
  SharpBody sharp{find_sharp_points(grid, body, shape,
                                    {kept_.gap, aside_in_spacings * spacing_,
                                     away_in_gaps * kept_.gap, keeps_in(sharp_.size())}),
                  {}};
  const auto tile = [&](int point) { return tile_of(point, grid.size()); };
  std::stable_sort(sharp.points.begin(), sharp.points.end(),
                   [&](int a, int b) { return tile(a) < tile(b); });
  for (int k = 0; k < static_cast<int>(sharp.points.size()); ++k) {
    if (k == 0 || tile(sharp.points[k]) != tile(sharp.points[k - 1])) sharp.tiles.push_back({k, 0});
    ++sharp.tiles.back().count;
  }
  any_sharp_ = any_sharp_ || !sharp.points.empty();
  sharp_.push_back(std::move(sharp));
}

void CornerContacts::find(const Step& step, std::span<const ContactBody> bodies, ThreadTeam& team) {
  contacts_.clear();
  if (!any_sharp_) return;
  Step known = step;
  if (step.boxes == nullptr) {
    if (boxes_.sides().empty()) boxes_ = PathBoxLevels(grid_.cells());
    const MovingSurface surface{&grid_, &step.cloth.start, &step.cloth.position};
    team.run([&](Worker& worker) { boxes_.fit(surface, worker); });
    known.boxes = &boxes_;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Search search{known, bodies[i], collide_kernels_for(team.instructions())};
    find_touches(search, sharp_[i], team);
    if (touches_.empty()) continue;
    team.run([&](Worker& worker) {
      found_.fill(static_cast<int>(touches_.size()), worker, [&](int t, std::vector<Contact>& out) {
        make_contact(search, touches_[t], out);
      });
    });
    append(found_, contacts_);
  }
}

/// The closest sharp point of each triangle that has any, in the triangles' order.
void CornerContacts::find_touches(const Search& search, const SharpBody& sharp, ThreadTeam& team) {
  touches_.clear();
  if (sharp.points.empty()) return;
  team.run([&](Worker& worker) {
    near_.fill(static_cast<int>(sharp.tiles.size()), worker, [&](int i, std::vector<Touch>& out) {
      const std::span<const int> points =
          std::span(sharp.points).subspan(sharp.tiles[i].first, sharp.tiles[i].count);
      const Nodes near = near_tile(search, points);
      if (near.count == 0) return;
      for (const int point : points) find_touches_of(search, near, point, out);
    });
  });
  append(near_, touches_);
  const auto order = [](const Touch& touch) {
    return std::tuple(touch.triangle, touch.squared_distance, touch.point);
  };
  std::sort(touches_.begin(), touches_.end(),
            [&](const Touch& a, const Touch& b) { return order(a) < order(b); });
  const auto same = [](const Touch& a, const Touch& b) { return a.triangle == b.triangle; };
  touches_.erase(std::unique(touches_.begin(), touches_.end(), same), touches_.end());
}

/// Where a tile's points may be near the cloth: the finest level of which there are few such nodes.
CornerContacts::Nodes CornerContacts::near_tile(const Search& search,
                                                std::span<const int> points) const {
  const PathBoxLevels& boxes = *search.step.boxes;
  const PathBox box = path_of(search.body, points);
  Nodes near{{Node{boxes.top(), 0, 0}}, 1};
  while (near.count > 0 && near.nodes[0].level > 1) {
    Nodes finer;
    for (int i = 0; i < near.count; ++i) {
      const Node& node = near.nodes[i];
      const unsigned marked =
          search.kernels.near_children(box, boxes.children(node), reach_of(search));
      for (int k = 0; k < 4; ++k) {
        if ((marked >> k & 1U) == 0) continue;
        if (finer.count == static_cast<int>(finer.nodes.size())) return near;
        finer.nodes[finer.count++] = {node.level - 1, 2 * node.row + k / 2, 2 * node.col + k % 2};
      }
    }
    near = finer;
  }
  return near;
}

float CornerContacts::reach_of(const Search& search) const {
  return static_cast<float>(contact_margin * kept_.gap) + search.step.aside;
}

void CornerContacts::find_touches_of(const Search& search, const Nodes& nodes, int point,
                                     std::vector<Touch>& out) const {
  const auto first = static_cast<std::ptrdiff_t>(out.size());
  const float reach = reach_of(search);
  const PathBox at = path_of(search.body.start->at(point), search.body.end->at(point));
  const PathBoxLevels& boxes = *search.step.boxes;
  const auto near = [&](const Node& node) {
    return search.kernels.near_children(at, boxes.children(node), reach);
  };
  for (int i = 0; i < nodes.count; ++i)
    for_near_cells(nodes.nodes[i], near, [&](const Node& node) {
      const int cell = node.row * grid_.cells() + node.col;
      for (const int triangle : {2 * cell, 2 * cell + 1})
        try_triangle(search, {triangle, point}, out);
    });
  // An edge counts where it is the closest part of both its triangles: otherwise the direction to
  // it may lie along the cloth, where a push would strain it.
  const auto twin = [&](const Touch& touch) {
    return std::any_of(out.begin() + first, out.end(), [&](const Touch& t) {
      return t.edge == touch.edge && t.triangle > touch.triangle;
    });
  };
  for (auto touch = out.begin() + first; touch != out.end(); ++touch)
    touch->counts = touch->edge[0] < 0 || twin(*touch);
  const auto idle = [](const Touch& touch) { return !touch.counts; };
  out.erase(std::remove_if(out.begin() + first, out.end(), idle), out.end());
}

void CornerContacts::try_triangle(const Search& search, Touch touch,
                                  std::vector<Touch>& out) const {
  const std::array<int, 3> samples = grid_.triangle(touch.triangle / 2, touch.triangle % 2);
  if (grid_.folded(samples)) return;
  const Vec3d point = vec_cast<double>(search.body.start->at(touch.point));
  const Corners start = corners_at(search.step.cloth.start, samples);
  const std::array<double, 3> w = closest_weights(point, start);
  const auto zeros = std::count(w.begin(), w.end(), 0.0);
  if (zeros > 1) return;  // samples have contacts of their own
  for (std::size_t k = 0; k < 3 && zeros == 1; ++k)
    if (w[k] == 0)
      touch.edge = in_order(grid_.point(samples[(k + 1) % 3]), grid_.point(samples[(k + 2) % 3]));
  const Vec3d apart = blend(start, w) - point;
  const double distance = length(apart);
  if (!(distance > 0)) return;
  const Vec3d displacement =
      blend(corners_at(search.step.cloth.position, samples), w) - blend(start, w);
  const Vec3d surface_displacement = vec_cast<double>(search.body.end->at(touch.point)) - point;
  if (distance + dot(apart, displacement - surface_displacement) / distance >=
      contact_margin * kept_.gap)
    return;
  touch.squared_distance = squared_length(apart);
  out.push_back(touch);
}

void CornerContacts::make_contact(const Search& search, const Touch& touch,
                                  std::vector<Contact>& out) const {
  const std::array<int, 3> samples = grid_.triangle(touch.triangle / 2, touch.triangle % 2);
  for (const int s : samples)
    if (search.step.inside[grid_.point(s)] == search.body.number) return;
  const Corners start = corners_at(search.step.cloth.start, samples);
  std::array<double, 3> w =
      closest_weights(vec_cast<double>(search.body.start->at(touch.point)), start);
  // Alternates projections, from the sharp point towards the closest points of both surfaces.
  const double reach = std::sqrt(touch.squared_distance) + kept_.gap;
  std::optional<BodyPoint> at;
  int near = search.body.query->triangles_around(touch.point).front();
  const auto look = [&] {
    at = search.body.query->closest(blend(start, w), reach, near);
    if (at) near = at->triangle;
    return at.has_value();
  };
  if (!look()) return;
  w = closest_weights(at->position, start);
  if (!look() || search.body.is_buried(at->triangle) || std::max({w[0], w[1], w[2]}) > nearly_all)
    return;
  ClothPoint point = point_of_triangle(search.step.cloth, samples, w);
  point.kept_in = keeps_in(search.body.number - 1);
  if (search.body.query->closed() && search.body.query->behind(point.start, *at) != point.kept_in)
    return;
  if (const auto contact = contact_before(search.body, *at, point, kept_)) out.push_back(*contact);
}

}  // namespace weft
