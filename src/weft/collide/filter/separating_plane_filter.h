#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "weft/collide/filter/separating_planes.h"
#include "weft/core/thread_team.h"

namespace weft {

/// A point of a cloth during a step, for the filter.
struct FilteredPoint {
  Vec3f start;          ///< [m]
  Vec3f safe_position;  ///< see SafePositions [m]
  Vec3f end;            ///< [m]; may be changed
  bool stays = false;   ///< pinned where it is
};

/// Moves the ends of points so that each lies on its side of all its planes. A point beyond planes
/// is projected onto them, if they are not too far; where that fails, it is stopped on its path
/// from its safe position to its end, as far as its planes let it [chen25]. The planes of stopped
/// points are then placed between safe positions, so that they hold back their other side too. All
/// planes are satisfied in the end, unless a body moves onto a point that has no free place.
class SeparatingPlaneFilter {
 public:
  struct Result {
    int aside = 0;    ///< points that were projected within the slack
    int far = 0;      ///< points that were projected farther
    int stopped = 0;  ///< points that were held back on their paths
    int lost = 0;     ///< points that still violate a plane
  };
  /// Numbers of the points that the last search stopped or lost, ascending.
  [[nodiscard]] std::span<const int> stopped() const { return stopped_; }
  /// Numbers of the points that the last search lost, ascending.
  [[nodiscard]] std::span<const int> lost() const { return lost_; }
  /// Numbers of the planes that moved points had violated with their proposed ends.
  [[nodiscard]] std::span<const int> struck() const { return struck_; }
  /// Limits of the displacement by projection onto planes.
  struct Aside {
    double slack = 0;     ///< displacement that planes allow for [m]
    double farthest = 0;  ///< at least the slack; displacements beyond that need a new search [m]
  };
  /// Whether all ends satisfy their planes already, so that none would be moved.
  template <class At>
  bool all_satisfied(std::span<const SeparatingPlane> planes, int count, const At& at,
                     ThreadTeam& team);
  /// Finds ends for all points on their sides of the planes.
  /// @param planes  changed: those of stopped points get their `still` levels
  /// @param count   number of points; planes refer to them by number
  /// @param at      the FilteredPoint of a number
  template <class At>
  Result find_ends(std::span<SeparatingPlane> planes, int count, const Aside& aside, const At& at,
                   ThreadTeam& team);
  /// Passes every end that the last search moved to put(point, end).
  template <class Put>
  void put_ends(const Put& put) const;

 private:
  struct Side {
    int plane = 0;
    int sign = 1;          ///< +1: side a
    bool halfway = false;  ///< limit of a turning plane, see SeparatingPlane::halfway
  };
  enum class Fate : char { free, aside, far, stopped, lost };

  void gather(std::span<const SeparatingPlane> planes, int count);
  [[nodiscard]] std::span<const Side> sides(int involved) const {
    return std::span(sides_).subspan(starts_[involved], starts_[involved + 1] - starts_[involved]);
  }
  /// Half-space that a plane prescribes for the end of a point.
  struct Limit {
    Vec3d normal;
    double offset = 0;
    /// Distance of an end beyond the plane; <= 0: it satisfies the plane. [m]
    [[nodiscard]] double beyond(Vec3d end) const { return offset - dot(normal, end); }
  };
  [[nodiscard]] static Limit limit_of(const SeparatingPlane& plane, const Side& side, Vec3f start);
  [[nodiscard]] bool satisfies_all(int involved, std::span<const SeparatingPlane> planes,
                                   const FilteredPoint& point, Vec3f place) const;
  /// @return displacement of the end by projection, infinity: no valid end was found [m]
  double put_aside(int involved, std::span<const SeparatingPlane> planes, double farthest,
                   FilteredPoint& point) const;
  /// @return whether the new end satisfies all planes
  bool stop(int involved, std::span<const SeparatingPlane> planes, FilteredPoint& point) const;
  Fate place(int involved, std::span<const SeparatingPlane> planes, const Aside& aside,
             const FilteredPoint& point, Vec3f& end) const;
  void update_planes(std::span<SeparatingPlane> planes, const Aside& aside);
  bool make_still(std::span<SeparatingPlane> planes, int involved);
  /// Planes that follow proposed ends are straight for points that may not stay there.
  void straighten_planes(std::span<SeparatingPlane> planes, const Aside& aside);
  /// Has the points of a plane placed anew.
  void mark_anew(const SeparatingPlane& plane);
  void place_anew(std::span<const SeparatingPlane> planes, const Aside& aside);
  Result count_fates();
  void find_struck(std::span<const SeparatingPlane> planes);

  std::vector<int> involved_;  // points of any plane, ascending
  std::vector<int> index_;     // [count] index of a point in involved_, -1: none
  std::vector<int> starts_, next_;
  std::vector<Side> sides_;            // compressed rows over involved_
  std::vector<FilteredPoint> points_;  // of involved_
  std::vector<Vec3f> ends_;            // results
  std::vector<Fate> fates_;
  std::vector<char> still_;  // per plane: has its still levels
  std::vector<char> held_;   // per involved point: to be stopped
  std::vector<int> stopped_, lost_, struck_;
  std::vector<char> is_struck_;  // per plane
  std::vector<char> anew_;       // per involved point: to be placed anew
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

template <class At>
SeparatingPlaneFilter::Result SeparatingPlaneFilter::find_ends(std::span<SeparatingPlane> planes,
                                                               int count, const Aside& aside,
                                                               const At& at, ThreadTeam& team) {
  stopped_.clear();
  lost_.clear();
  struck_.clear();
  fates_.clear();
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
  straighten_planes(planes, aside);
  update_planes(planes, aside);
  find_struck(planes);
  return count_fates();
}

template <class Put>
void SeparatingPlaneFilter::put_ends(const Put& put) const {
  for (std::size_t i = 0; i < fates_.size(); ++i)
    if (fates_[i] != Fate::free) put(involved_[i], ends_[i]);
}

}  // namespace weft
