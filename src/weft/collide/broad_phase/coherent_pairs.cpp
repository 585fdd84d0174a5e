#include "weft/collide/broad_phase/coherent_pairs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "weft/collide/broad_phase/cell_gaps.h"

namespace weft {
CoherentPairs::CoherentPairs(std::unique_ptr<BroadPhase> broad_phase,
                             std::span<const SurfaceGrid* const> surfaces, std::size_t cloths,
                             float skin)
    : broad_phase_(std::move(broad_phase)),
      skin_(skin),
      snapshots_(surfaces.size()),
      found_slack_(cloths),
      lists_(cloths * surfaces.size()) {
  for (const SurfaceGrid* cloth : surfaces.first(cloths)) windows_.emplace_back(cloth->cells());
}

void CoherentPairs::forget() {
  known_ = false;
  for (List& list : lists_) list.reach = list.slack = 0;
}

float CoherentPairs::distance_from(const Snapshot& snapshot, const MovingSurface& now) const {
  if (now.name != 0 && now.name == snapshot.name) return 0;
  const Planes3& end = snapshot.still ? snapshot.start : snapshot.end;
  double distance = largest_displacement(snapshot.start, *now.start);
  if (!snapshot.still || now.end != now.start)
    distance = std::max(distance, largest_displacement(end, *now.end));
  // Half the skin, less rounding.
  return distance < 0.499 * double{skin_} ? static_cast<float>(distance) : HUGE_VALF;
}

void CoherentPairs::remember(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
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
    snapshot.distance = 0;
  }
  for (List& list : lists_) list.known = false;
  broad_phase_->refit(placed_, team);
  known_ = true;
}

void CoherentPairs::refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  now_.assign(surfaces.begin(), surfaces.end());
  std::fill(found_slack_.begin(), found_slack_.end(), -1.0F);
  for (std::size_t i = 0; known_ && i < surfaces.size(); ++i) {
    snapshots_[i].distance = distance_from(snapshots_[i], surfaces[i]);
    known_ = snapshots_[i].distance < HUGE_VALF;
  }
  if (!known_) remember(surfaces, team);
}

void CoherentPairs::sort(int a, int b, List& list, ThreadTeam& team) {
  const float reach = list.reach + skin_, per_bucket = buckets / reach;
  near_.fill(static_cast<int>(list.cells.size()), team, [&](int i, std::vector<Found>& mine) {
    const CandidatePair cells = list.cells[i];
    const float gap = CellGaps(placed_[a], cells.a, placed_[b], cells.b).certain_gap();
    if (gap < reach) mine.push_back({cells, gap > 0 ? static_cast<int>(gap * per_bucket) : 0});
  });
  order(near_, list);
  list.sorted = true;
}

void CoherentPairs::order(const ChunkedLists<std::vector<Found>>& found, List& list) {
  list.ends.fill(0);
  const auto bucket_of = [](const Found& one) {
    return std::min(static_cast<std::size_t>(one.bucket), buckets - 1);
  };
  for (const std::vector<Found>& part : found.lists())
    for (const Found& one : part) ++list.ends[bucket_of(one)];
  std::size_t count = 0;
  for (std::size_t& end : list.ends) count += std::exchange(end, count);
  list.cells.resize(count);
  // Each bucket's begin serves as its write position, and ends up as its end.
  for (const std::vector<Found>& part : found.lists())
    for (const Found& one : part) list.cells[list.ends[bucket_of(one)]++] = one.cells;
}

std::span<const CandidatePair> CoherentPairs::nearest(int a, int b, float reach, ThreadTeam& team) {
  List& list = list_of(a, b);
  if (!list.sorted) sort(a, b, list, team);
  const float far = reach + snapshots_[a].distance + snapshots_[b].distance;
  const auto last = static_cast<std::size_t>(far * buckets / (list.reach + skin_));
  return std::span(list.cells).first(list.ends[std::min(last, buckets - 1)]);
}

std::span<const CandidatePair> CoherentPairs::find(int surface_a, int surface_b, float reach,
                                                   ThreadTeam& team) {
  List& list = list_of(surface_a, surface_b);
  if (list.known && reach <= list.reach) return nearest(surface_a, surface_b, reach, team);
  list.reach = std::max(list.reach, reach);
  list.known = true;
  list.sorted = false;
  list.cells.clear();
  broad_phase_->find(surface_a, surface_b, list.reach + skin_, team, list.cells);
  return list.cells;
}

void CoherentPairs::find_unfolded(int surface, float slack, ThreadTeam& team) {
  float& found = found_slack_[static_cast<std::size_t>(surface)];
  if (found != slack)
    windows_[static_cast<std::size_t>(surface)].find_unfolded(now_[surface], slack, team);
  found = slack;
}

/// Sets neighbours in unfolded rectangles apart: they are most of all pairs, and their gaps are of
/// no use.
void CoherentPairs::set_smooth_aside(int surface, List& list) {
  const UnfoldedWindows& windows = windows_[static_cast<std::size_t>(surface)];
  std::size_t kept = 0;
  for (const CandidatePair& pair : list.cells) {
    if (windows.unfolded(pair))
      list.smooth.push_back(pair);
    else
      list.cells[kept++] = pair;
  }
  list.cells.resize(kept);
}

/// Unfolded neighbours are left out also because planes between them would hinder rotation.
std::span<const CandidatePair> CoherentPairs::find_self(int surface, float reach, float slack,
                                                        ThreadTeam& team) {
  List& list = list_of(surface, surface);
  const bool known = list.known && reach <= list.reach && slack <= list.slack;
  if (!known) {
    list.reach = std::max(list.reach, reach);
    list.slack = std::max(list.slack, slack);
    list.known = true;
    list.sorted = false;
    list.cells.clear();
    broad_phase_->find_self(surface, list.reach + skin_, list.slack + 0.5F * skin_, team,
                            list.cells);
    list.smooth.clear();
    if (list.cells.empty()) return {};
    find_unfolded(surface, slack, team);
    set_smooth_aside(surface, list);
    return list.cells;
  }
  if (list.cells.empty() && list.smooth.empty()) return {};
  find_unfolded(surface, slack, team);
  const UnfoldedWindows& windows = windows_[static_cast<std::size_t>(surface)];
  const std::span<const CandidatePair> near = nearest(surface, surface, reach, team);
  folded_.clear();
  for (const std::span<const CandidatePair> cells :
       {near, std::span<const CandidatePair>(list.smooth)})
    shared_.collect(static_cast<int>(cells.size()), team, folded_,
                    [&](int i, std::vector<CandidatePair>& mine) {
                      if (!windows.unfolded(cells[i])) mine.push_back(cells[i]);
                    });
  return folded_;
}

}  // namespace weft
