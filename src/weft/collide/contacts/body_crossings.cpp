#include "weft/collide/contacts/body_crossings.h"

#include <algorithm>
#include <tuple>

#include "weft/collide/broad_phase/tiling.h"
#include "weft/collide/contacts/closest.h"
#include "weft/mesh/crossings.h"

namespace weft {
namespace {

/// Calls visit(point) where the edges of a triangle pass through another.
template <class Visit>
void for_passages(const Corners& edges_of, const Corners& through, const Visit& visit) {
  const Vec3d normal = cross(through[1] - through[0], through[2] - through[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d from = edges_of[k], to = edges_of[(k + 1) % 3];
    const double before = dot(normal, from - through[0]), beyond = dot(normal, to - through[0]);
    if ((before < 0) == (beyond < 0)) continue;
    const Vec3d at = from + before / (before - beyond) * (to - from);
    const auto within = [&](std::size_t side) {
      const Vec3d along = through[(side + 1) % 3] - through[side];
      return dot(normal, cross(along, at - through[side])) >= 0;
    };
    if (within(0) && within(1) && within(2)) visit(at);
  }
}

}  // namespace

void BodyCrossings::try_pair(const Standing& standing, int triangle, int body_triangle,
                             std::vector<Meeting>& out) {
  const std::array<int, 3> a = standing.grid.triangle(triangle / 2, triangle % 2),
                           b = standing.body_grid.triangle(body_triangle / 2, body_triangle % 2);
  if (standing.grid.folded(a) || standing.body_grid.folded(b) ||
      standing.body.is_buried(body_triangle))
    return;
  const Corners own = corners_at(standing.cloth, a), other = corners_at(*standing.body.start, b);
  if (!triangles_cross(own, other)) return;
  Meeting meeting{triangle, body_triangle, {}, 0};
  const auto add = [&](Vec3d end) {
    meeting.sum += end;
    ++meeting.ends;
  };
  for_passages(own, other, add);
  for_passages(other, own, add);
  out.push_back(meeting);
}

void BodyCrossings::join_meetings() {
  const auto order = [](const Meeting& m) { return std::tuple(m.triangle, m.body_triangle); };
  std::sort(meetings_.begin(), meetings_.end(),
            [&](const Meeting& a, const Meeting& b) { return order(a) < order(b); });
  auto last = meetings_.begin();
  for (auto next = meetings_.begin(); next != meetings_.end(); ++next) {
    if (next == last) continue;
    if (next->triangle != last->triangle) {
      *++last = *next;
      continue;
    }
    last->sum += next->sum;
    last->ends += next->ends;
  }
  if (!meetings_.empty()) meetings_.erase(last + 1, meetings_.end());
}

void BodyCrossings::clear() {
  for (const Meeting& meeting : meetings_) crosses_[meeting.triangle] = 0;
  meetings_.clear();
}

void BodyCrossings::forget() {
  clear();
  open_ = true;
}

void BodyCrossings::find(const Standing& standing, std::span<const CandidateTile> cells,
                         ThreadTeam& team) {
  const Tiling tiling(standing.grid.cells()), body_tiling(standing.body_grid.cells());
  found_.fill(static_cast<int>(cells.size()), team, [&](int k, std::vector<Meeting>& out) {
    for_pairs(cells[k], tiling, body_tiling, [&](const CandidatePair& pair) {
      for (const int half : {0, 1})
        for (const int body_half : {0, 1})
          try_pair(standing, 2 * pair.a + half, 2 * pair.b + body_half, out);
    });
  });
  clear();
  append(found_, meetings_);
  join_meetings();
  open_ = !meetings_.empty();
  const auto side = static_cast<std::size_t>(standing.grid.cells());
  crosses_.resize(2 * side * side, 0);
  for (const Meeting& meeting : meetings_) crosses_[meeting.triangle] = 1;
}

void BodyCrossings::add_contacts(const SurfaceGrid& grid, const MovingCloth& cloth,
                                 const ContactBody& body, const Exit& exit,
                                 std::vector<Contact>& out) const {
  for (const Meeting& meeting : meetings_) {
    const std::array<int, 3> samples = grid.triangle(meeting.triangle / 2, meeting.triangle % 2);
    const bool has_own = std::any_of(samples.begin(), samples.end(), [&](int s) {
      return exit.inside[grid.point(s)] == body.number;
    });
    if (has_own || meeting.ends == 0) continue;
    // Amid the ends of segments, so most likely inside.
    const Vec3d amid = (1.0 / meeting.ends) * meeting.sum;
    ClothPoint point =
        point_of_triangle(cloth, samples, closest_weights(amid, corners_at(cloth.start, samples)));
    point.kept_in = exit.kept_in;
    point.astray = true;
    point.farthest = exit.farthest;
    const auto at = body.query->closest(point.start, HUGE_VAL, meeting.body_triangle);
    if (!at || body.is_buried(at->triangle) || body.query->behind(point.start, *at) == exit.kept_in)
      continue;
    if (const auto contact = contact_before(body, *at, point, exit.kept)) out.push_back(*contact);
  }
}

}  // namespace weft
