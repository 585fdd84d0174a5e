#include "weft/collide/filter/separating_plane_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

/// Largest number of projection sweeps over the planes of a point. Where planes meet at sharp
/// angles more would be needed, and the point is stopped instead.
constexpr int max_turns = 12;
/// Points are projected this much farther than a plane prescribes, relative to 1 + |offset| and
/// within the plane's margin, against rounding.
constexpr double overshoot = 0.5e-6;

}  // namespace

void SeparatingPlaneFilter::gather(std::span<const SeparatingPlane> planes, int count) {
  index_.resize(static_cast<std::size_t>(count), -1);
  for (const int point : involved_) index_[point] = -1;
  involved_.clear();
  for (const SeparatingPlane& plane : planes)
    for (int k = 0; k < plane.count_a + plane.count_b; ++k)
      if (int& index = index_[plane.points[k]]; index < 0) {
        index = 0;
        involved_.push_back(plane.points[k]);
      }
  std::sort(involved_.begin(), involved_.end());
  for (std::size_t i = 0; i < involved_.size(); ++i) index_[involved_[i]] = static_cast<int>(i);
  starts_.assign(involved_.size() + 1, 0);
  for (const SeparatingPlane& plane : planes)
    for (int k = 0; k < plane.count_a + plane.count_b; ++k)
      starts_[index_[plane.points[k]] + 1] += plane.turns ? 2 : 1;
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  sides_.resize(static_cast<std::size_t>(starts_.back()));
  next_.assign(starts_.begin(), starts_.end() - 1);
  for (int p = 0; p < static_cast<int>(planes.size()); ++p)
    for (int k = 0; k < planes[p].count_a + planes[p].count_b; ++k) {
      const int sign = k < planes[p].count_a ? 1 : -1;
      int& next = next_[index_[planes[p].points[k]]];
      sides_[next++] = {p, sign, false};
      if (planes[p].turns) sides_[next++] = {p, sign, true};
    }
  still_.assign(planes.size(), 0);
  held_.assign(involved_.size(), 0);
  anew_.assign(involved_.size(), 0);
}

SeparatingPlaneFilter::Limit SeparatingPlaneFilter::limit_of(const SeparatingPlane& plane,
                                                             const Side& side, Vec3f start) {
  const PlaneLevels& levels = side.halfway ? plane.halfway : plane.at_end;
  const double level = side.sign > 0 ? levels.a : levels.b;
  const double come = side.halfway ? dot(plane.turned, vec_cast<double>(start)) : 0;
  const Vec3d& normal = side.halfway ? plane.normal : plane.turned;
  return {static_cast<double>(side.sign) * normal, side.sign * (level - come)};
}

bool SeparatingPlaneFilter::satisfies_all(int involved, std::span<const SeparatingPlane> planes,
                                          const FilteredPoint& point, Vec3f place) const {
  const Vec3d at = vec_cast<double>(place);
  return std::all_of(sides(involved).begin(), sides(involved).end(), [&](const Side& side) {
    return limit_of(planes[side.plane], side, point.start).beyond(at) <= 0;
  });
}

double SeparatingPlaneFilter::put_aside(int involved, std::span<const SeparatingPlane> planes,
                                        double farthest, FilteredPoint& point) const {
  Vec3d at = vec_cast<double>(point.end);
  for (int turn = 0; turn < max_turns; ++turn) {
    bool moved = false;
    for (const Side& side : sides(involved)) {
      const Limit limit = limit_of(planes[side.plane], side, point.start);
      const double distance = limit.beyond(at);
      if (distance <= 0) continue;
      at += (distance + overshoot * (1 + std::abs(limit.offset))) * limit.normal;
      moved = true;
    }
    if (!moved) break;
  }
  const Vec3f rounded = vec_cast<float>(at);
  const double distance = length(vec_cast<double>(rounded) - vec_cast<double>(point.end));
  if (!(distance <= farthest) || !satisfies_all(involved, planes, point, rounded)) return HUGE_VAL;
  point.end = rounded;
  return distance;
}

bool SeparatingPlaneFilter::stop(int involved, std::span<const SeparatingPlane> planes,
                                 FilteredPoint& point) const {
  const Vec3d safe_position = vec_cast<double>(point.safe_position),
              distance = vec_cast<double>(point.end) - safe_position;
  double share = 1;
  for (const Side& side : sides(involved)) {
    const Limit limit = limit_of(planes[side.plane], side, point.start);
    const double at_safe_position = limit.beyond(safe_position),
                 at_end = limit.beyond(safe_position + distance);
    if (at_end > 0 && at_end > at_safe_position)
      share = std::min(share, -at_safe_position / (at_end - at_safe_position));
  }
  // A little less, so that rounding does not put it beyond a plane.
  const Vec3f rounded = vec_cast<float>(safe_position + (0.9 * std::max(0.0, share)) * distance);
  point.end =
      share > 0 && satisfies_all(involved, planes, point, rounded) ? rounded : point.safe_position;
  return satisfies_all(involved, planes, point, point.end);
}

SeparatingPlaneFilter::Fate SeparatingPlaneFilter::place(int involved,
                                                         std::span<const SeparatingPlane> planes,
                                                         const Aside& aside,
                                                         const FilteredPoint& point,
                                                         Vec3f& end) const {
  end = point.end;
  if (held_[involved] == 0 && satisfies_all(involved, planes, point, end)) return Fate::free;
  FilteredPoint tried = point;
  const double distance = held_[involved] == 0 && !point.stays
                              ? put_aside(involved, planes, aside.farthest, tried)
                              : HUGE_VAL;
  if (distance < HUGE_VAL) {
    end = tried.end;
    return distance <= aside.slack ? Fate::aside : Fate::far;
  }
  tried = point;
  const bool kept = stop(involved, planes, tried);
  end = tried.end;
  return kept ? Fate::stopped : Fate::lost;
}

bool SeparatingPlaneFilter::make_still(std::span<SeparatingPlane> planes, int involved) {
  bool changed = false;
  for (const Side& side : sides(involved)) {
    if (still_[side.plane] != 0) continue;
    still_[side.plane] = 1;
    SeparatingPlane& plane = planes[side.plane];
    const bool turned = plane.follows_ends;
    if (turned) straighten(plane);
    if (!turned && plane.at_end == plane.still) continue;
    plane.at_end = plane.still;
    changed = true;
    mark_anew(plane);
  }
  return changed;
}

void SeparatingPlaneFilter::mark_anew(const SeparatingPlane& plane) {
  for (int k = 0; k < plane.count_a + plane.count_b; ++k) anew_[index_[plane.points[k]]] = 1;
}

void SeparatingPlaneFilter::place_anew(std::span<const SeparatingPlane> planes,
                                       const Aside& aside) {
  for (int i = 0; i < static_cast<int>(involved_.size()); ++i)
    if (std::exchange(anew_[i], 0) != 0) fates_[i] = place(i, planes, aside, points_[i], ends_[i]);
}

void SeparatingPlaneFilter::straighten_planes(std::span<SeparatingPlane> planes,
                                              const Aside& aside) {
  for (bool changed = true; changed;) {
    changed = false;
    for (int i = 0; i < static_cast<int>(involved_.size()); ++i) {
      if (fates_[i] == Fate::free) continue;
      for (const Side& side : sides(i)) {
        SeparatingPlane& plane = planes[side.plane];
        if (!plane.follows_ends) continue;
        straighten(plane);
        mark_anew(plane);
        changed = true;
      }
    }
    if (changed) place_anew(planes, aside);
  }
}

void SeparatingPlaneFilter::update_planes(std::span<SeparatingPlane> planes, const Aside& aside) {
  for (bool changed = true; changed;) {
    changed = false;
    for (int i = 0; i < static_cast<int>(involved_.size()); ++i) {
      if (held_[i] != 0 || (fates_[i] != Fate::stopped && fates_[i] != Fate::lost)) continue;
      held_[i] = 1;
      changed = make_still(planes, i) || changed;
    }
    place_anew(planes, aside);
  }
}

void SeparatingPlaneFilter::find_struck(std::span<const SeparatingPlane> planes) {
  is_struck_.assign(planes.size(), 0);
  for (int i = 0; i < static_cast<int>(involved_.size()); ++i) {
    if (fates_[i] == Fate::free) continue;
    const Vec3d wanted = vec_cast<double>(points_[i].end);
    for (const Side& side : sides(i))
      if (limit_of(planes[side.plane], side, points_[i].start).beyond(wanted) > 0)
        is_struck_[side.plane] = 1;
  }
  for (int p = 0; p < static_cast<int>(planes.size()); ++p)
    if (is_struck_[p] != 0) struck_.push_back(p);
}

SeparatingPlaneFilter::Result SeparatingPlaneFilter::count_fates() {
  Result result;
  for (std::size_t i = 0; i < fates_.size(); ++i) {
    const Fate fate = fates_[i];
    if (fate == Fate::aside) ++result.aside;
    if (fate == Fate::far) ++result.far;
    if (fate == Fate::stopped) ++result.stopped;
    if (fate == Fate::lost) ++result.lost;
    if (fate == Fate::stopped || fate == Fate::lost) stopped_.push_back(involved_[i]);
    if (fate == Fate::lost) lost_.push_back(involved_[i]);
  }
  return result;
}

}  // namespace weft
