#include "weft/collide/pairs/coherent_pairs.h"

#include <algorithm>

#include "weft/collide/pairs/cell_gaps.h"

namespace weft {
namespace {

bool same_within(const Planes3& a, const Planes3& b, float way) {
  const int n = a.size();
  float most = 0;
  for (int r = 0; r < n; ++r) {
    const float *ax = a.x.row(r), *ay = a.y.row(r), *az = a.z.row(r);
    const float *bx = b.x.row(r), *by = b.y.row(r), *bz = b.z.row(r);
    for (int c = 0; c < n; ++c) {
      const float x = ax[c] - bx[c], y = ay[c] - by[c], z = az[c] - bz[c];
      const float square = x * x + y * y + z * z;
      most = square > most ? square : most;
    }
    if (!(most <= way * way)) return false;
  }
  return true;
}

}  // namespace

CoherentPairs::CoherentPairs(std::unique_ptr<BroadPhase> broad_phase, std::size_t surfaces,
                             std::size_t cloths, float skin)
    : broad_phase_(std::move(broad_phase)),
      skin_(skin),
      snapshots_(surfaces),
      lists_(cloths * surfaces) {}

void CoherentPairs::forget() {
  known_ = false;
  for (List& list : lists_) list.reach = list.slack = 0;
}

bool CoherentPairs::holds(const Snapshot& snapshot, const MovingSurface& now) const {
  if (now.name != 0 && now.name == snapshot.name) return true;
  const float way = 0.499F * skin_;  // less rounding
  if (!same_within(snapshot.start, *now.start, way)) return false;
  if (snapshot.still && now.end == now.start) return true;
  return same_within(snapshot.still ? snapshot.start : snapshot.end, *now.end, way);
}

void CoherentPairs::take(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  placed_.clear();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    Snapshot& snapshot = snapshots_[i];
    MovingSurface placed = surfaces[i];
    if (placed.name == 0 || placed.name != snapshot.name) {
      snapshot.still = placed.end == placed.start;
      snapshot.name = placed.name;
      snapshot.start = *placed.start;
      if (!snapshot.still) snapshot.end = *placed.end;
    }
    placed.start = &snapshot.start;
    placed.end = snapshot.still ? &snapshot.start : &snapshot.end;
    placed_.push_back(placed);
  }
  for (List& list : lists_) list.known = false;
  broad_phase_->refit(placed_, team);
  known_ = true;
}

void CoherentPairs::refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  for (std::size_t i = 0; known_ && i < surfaces.size(); ++i)
    known_ = holds(snapshots_[i], surfaces[i]);
  if (!known_) take(surfaces, team);
}

/// Of what was found, boxes of which came near, those whose cells did.
void CoherentPairs::keep_near(int a, int b, List& list, ThreadTeam& team) {
  const double reach = double{list.reach} + double{skin_};
  near_.collect(static_cast<int>(found_.size()), team, list.cells,
                [&](int i, std::vector<CellPair>& mine) {
                  const CellGaps gaps(placed_[a], found_[i].a, placed_[b], found_[i].b);
                  if (!gaps.apart(reach, reach)) mine.push_back(found_[i]);
                });
  list.known = true;
}

std::span<const CellPair> CoherentPairs::find(int surface_a, int surface_b, float reach,
                                              ThreadTeam& team) {
  List& list = list_of(surface_a, surface_b);
  if (list.known && reach <= list.reach) return list.cells;
  list.reach = std::max(list.reach, reach);
  list.cells.clear();
  found_.clear();
  broad_phase_->find(surface_a, surface_b, list.reach + skin_, team, found_);
  keep_near(surface_a, surface_b, list, team);
  return list.cells;
}

std::span<const CellPair> CoherentPairs::find_self(int surface, float reach, float slack,
                                                   ThreadTeam& team) {
  List& list = list_of(surface, surface);
  if (list.known && reach <= list.reach && slack <= list.slack) return list.cells;
  list.reach = std::max(list.reach, reach);
  list.slack = std::max(list.slack, slack);
  list.cells.clear();
  found_.clear();
  broad_phase_->find_self(surface, list.reach + skin_, list.slack + 0.5F * skin_, team, found_);
  keep_near(surface, surface, list, team);
  return list.cells;
}

}  // namespace weft
