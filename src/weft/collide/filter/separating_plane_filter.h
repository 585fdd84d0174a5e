#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "weft/collide/filter/separating_planes.h"
#include "weft/core/thread_team.h"

namespace weft {

/// A point of a cloth during a step, for the filter.
struct FilteredPoint {
  Vec3f start;  ///< [m]
  Vec3f
      safe_position;  ///< where it is free at the end whatever the others do, see SafePositions [m]
  Vec3f end;          ///< [m]; may be changed
};

/// Moves the ends of points so that each lies on its sides of all its planes. A point is put onto
/// the planes that it is beyond, if they are not too far; where that does not do, it stays on its
/// way from its refuge to its end as far as its planes let it [chen25], and these planes, which
/// from then on stand between refuges, hold back what is on their other side too. So
/// every plane is heeded in the end, unless a body moves onto a point that has nowhere to go.
class SeparatingPlaneFilter {
 public:
  struct Result {
    int aside = 0;    ///< points that were moved aside within the slack
    int far = 0;      ///< points that were moved farther
    int stopped = 0;  ///< points that were held back on their way
    int lost = 0;     ///< points that could not be kept on their sides
  };
  /// Numbers of the points that the last hold stopped or lost, ascending.
  [[nodiscard]] std::span<const int> stopped() const { return stopped_; }
  /// Those that it lost, ascending.
  [[nodiscard]] std::span<const int> lost() const { return lost_; }
  /// Numbers of the planes that points it moved had been beyond.
  [[nodiscard]] std::span<const int> struck() const { return struck_; }
  /// How far points may be moved aside.
  struct Aside {
    double slack = 0;     ///< what planes reckon with [m]
    double farthest = 0;  ///< at least the slack; what moves farther has to be looked at again [m]
  };
  /// Whether all ends are on their sides already: hold would change nothing.
  template <class At>
  bool all_satisfied(std::span<const SeparatingPlane> planes, int count, const At& at,
                     ThreadTeam& team);
  /// @param planes  changed: those that had to stay still get their still offsets
  /// @param count   points in all; planes name them by number
  /// @param at      the FilteredPoint of a number; put(point, end) changes the end
  template <class At, class Put>
  Result hold(std::span<SeparatingPlane> planes, int count, const Aside& aside, const At& at,
              const Put& put, ThreadTeam& team);

 private:
  struct Side {
    int plane = 0;
    int sign = 1;          ///< +1: side a
    bool halfway = false;  ///< what a plane that turns asks for in the middle of the step
  };
  enum class Fate : char { free, aside, far, stopped, lost };

  void gather(std::span<const SeparatingPlane> planes, int count);
  [[nodiscard]] std::span<const Side> sides(int involved) const {
    return std::span(sides_).subspan(starts_[involved], starts_[involved + 1] - starts_[involved]);
  }
  /// What a plane asks of the end of a point.
  struct Limit {
    Vec3d normal;
    double offset = 0;
    /// How far on the wrong side; <= 0: not at all. [m]
    [[nodiscard]] double beyond(Vec3d end) const { return offset - dot(normal, end); }
  };
  [[nodiscard]] static Limit limit_of(const SeparatingPlane& plane, const Side& side, Vec3f start);
  [[nodiscard]] bool satisfies_all(int involved, std::span<const SeparatingPlane> planes,
                                   const FilteredPoint& point, Vec3f place) const;
  /// @return how far aside a place was found, infinity: nowhere [m]
  double put_aside(int involved, std::span<const SeparatingPlane> planes, double farthest,
                   FilteredPoint& point) const;
  /// @return whether its planes let it stay on its way at all
  bool stop(int involved, std::span<const SeparatingPlane> planes, FilteredPoint& point) const;
  Fate place(int involved, std::span<const SeparatingPlane> planes, const Aside& aside,
             const FilteredPoint& point, Vec3f& end) const;
  void update_planes(std::span<SeparatingPlane> planes, const Aside& aside);
  bool make_still(std::span<SeparatingPlane> planes, int involved);
  Result count_fates();
  void find_struck(std::span<const SeparatingPlane> planes);

  std::vector<int> involved_;  // points that planes name, ascending
  std::vector<int> index_;     // [count] of a point among them, -1: none
  std::vector<int> starts_, next_;
  std::vector<Side> sides_;            // compressed rows over involved_
  std::vector<FilteredPoint> points_;  // of involved_
  std::vector<Vec3f> ends_;            // results
  std::vector<Fate> fates_;
  std::vector<char> still_;  // of planes
  std::vector<char> held_;   // of involved points: to be stopped
  std::vector<int> stopped_, lost_, struck_;
  std::vector<char> is_struck_;  // of planes
  std::vector<char> anew_;       // of involved points: to be placed anew
};

template <class At>
bool SeparatingPlaneFilter::all_satisfied(std::span<const SeparatingPlane> planes, int count,
                                          const At& at, ThreadTeam& team) {
  stopped_.clear();
  lost_.clear();
  struck_.clear();
  if (planes.empty()) return true;
  gather(planes, count);
  const int points = static_cast<int>(involved_.size());
  fates_.assign(involved_.size(), Fate::free);
  team.run([&](Worker& worker) {
    const Range mine = worker.share(points);
    for (int i = mine.first; i < mine.last; ++i) {
      const FilteredPoint point = at(involved_[i]);
      if (!satisfies_all(i, planes, point, point.end)) fates_[i] = Fate::aside;
    }
  });
  return std::all_of(fates_.begin(), fates_.end(), [](Fate fate) { return fate == Fate::free; });
}

template <class At, class Put>
SeparatingPlaneFilter::Result SeparatingPlaneFilter::hold(std::span<SeparatingPlane> planes,
                                                          int count, const Aside& aside,
                                                          const At& at, const Put& put,
                                                          ThreadTeam& team) {
  stopped_.clear();
  lost_.clear();
  struck_.clear();
  if (planes.empty()) return {};
  gather(planes, count);
  const int points = static_cast<int>(involved_.size());
  points_.resize(involved_.size());
  ends_.resize(involved_.size());
  fates_.resize(involved_.size());
  team.run([&](Worker& worker) {
    const Range mine = worker.share(points);
    for (int i = mine.first; i < mine.last; ++i) {
      points_[i] = at(involved_[i]);
      fates_[i] = place(i, planes, aside, points_[i], ends_[i]);
    }
  });
  update_planes(planes, aside);
  find_struck(planes);
  for (int i = 0; i < points; ++i)
    if (fates_[i] != Fate::free) put(involved_[i], ends_[i]);
  return count_fates();
}

}  // namespace weft
