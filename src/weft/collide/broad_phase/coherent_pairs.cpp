#include "weft/collide/broad_phase/coherent_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "weft/collide/broad_phase/shared_points.h"

namespace weft {
namespace {

/// Where the pair of a candidate's patches stands in lists.
struct Place {
  int patch_a;
  unsigned of_b;
  friend bool operator<(const Place& p, const Place& q) {
    return p.patch_a != q.patch_a ? p.patch_a < q.patch_a : p.of_b < q.of_b;
  }
};
Place place_of(const CandidateTile& one, const Tiling& of_a) {
  return {of_a.patch_a(one),
          place_in_order(one.row_b / Tiling::patch_side, one.col_b / Tiling::patch_side)};
}

}  // namespace

CoherentPairs::CoherentPairs(std::unique_ptr<BroadPhase> broad_phase,
                             std::span<const SurfaceGrid* const> surfaces, std::size_t cloths,
                             float skin)
    : broad_phase_(std::move(broad_phase)),
      skin_(skin),
      names_(surfaces.size()),
      found_slack_(cloths),
      lists_(cloths * surfaces.size()) {
  for (const SurfaceGrid* surface : surfaces) {
    motions_.emplace_back(surface->cells());
    tiles_.emplace_back(*surface);
  }
  for (const SurfaceGrid* cloth : surfaces.first(cloths)) {
    windows_.emplace_back(cloth->cells());
    self_versions_.emplace_back(cloth->cells());
  }
}

void CoherentPairs::forget() {
  std::fill(names_.begin(), names_.end(), 0);
  for (PatchMotion& motion : motions_) motion.forget();
  for (List& list : lists_) {
    list.version = -1;
    list.reach = 0;
  }
}

void CoherentPairs::refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) {
  now_.assign(surfaces.begin(), surfaces.end());
  ++version_;
  boxes_fit_ = false;
  std::fill(found_slack_.begin(), found_slack_.end(), -1.0F);
  const auto is_measured = [&](std::size_t i) {
    return now_[i].name != 0 && now_[i].name == names_[i];
  };
  bool large = false;
  for (std::size_t i = 0; i < now_.size(); ++i)
    large = large || (!is_measured(i) && now_[i].grid->cells() >= min_shared_cells);
  team.run_if(large, [&](Worker& worker) {
    for (std::size_t i = 0; i < now_.size(); ++i)
      if (!is_measured(i)) motions_[i].measure(now_[i], worker);
  });
  for (std::size_t i = 0; i < now_.size(); ++i) {
    tiles_[i].take(now_[i]);
    if (is_measured(i)) continue;
    // Half the skin, less rounding.
    motions_[i].renew(now_[i], 0.499F * skin_, version_);
    names_[i] = now_[i].name;
    if (motions_[i].versions().latest() < version_) continue;
    boxes_known_ = false;
    if (i < self_versions_.size()) self_versions_[i].take(motions_[i].versions(), version_);
  }
}

void CoherentPairs::fit_boxes(ThreadTeam& team) {
  if (!boxes_fit_) broad_phase_->refit(now_, team);
  boxes_fit_ = boxes_known_ = true;
}

const PathBoxLevels* CoherentPairs::boxes(int surface, ThreadTeam& team) {
  if (!boxes_known_) fit_boxes(team);
  return broad_phase_->boxes(surface);
}

void CoherentPairs::fit_tiles(int a, int b, std::span<const CandidateTile> of, ThreadTeam& team) {
  tiles_[static_cast<std::size_t>(a)].fit(of, false, team);
  tiles_[static_cast<std::size_t>(b)].fit(of, true, team);
}

/// The surfaces' other patches may be half a skin from where they were renewed, on this side now
/// and on that side later.
bool CoherentPairs::search(int a, int b, const List& list, float slack, ThreadTeam& team) {
  fit_boxes(team);
  fresh_.clear();
  const float reach = list.reach + 1.5F * skin_;
  const bool self = a == b;
  const ChangedPatches changed{&versions(a, self), &versions(b, self), list.version,
                               self ? &windows_[static_cast<std::size_t>(a)] : nullptr};
  if (broad_phase_->find_changed(a, b, reach, changed, team, fresh_)) return false;
  if (self) {
    broad_phase_->find_self(a, reach, slack + skin_, team, fresh_);
    drop_neighbours();
  } else {
    broad_phase_->find(a, b, reach, team, fresh_);
  }
  return true;
}

void CoherentPairs::widen(List& list, float reach) {
  if (reach <= list.reach) return;
  list.reach = reach;
  list.version = -1;
}

void CoherentPairs::complete(int a, int b, List& list, float slack, ThreadTeam& team) {
  const bool self = a == b;
  if (std::max(versions(a, self).latest(), versions(b, self).latest()) <= list.version) return;
  if (search(a, b, list, slack, team)) list.version = -1;
  refine(a, b, list.reach, team);
  merge(a, b, list.version, fresh_, list.tiles);
  list.version = version_;
}

void CoherentPairs::refine(int a, int b, float reach, ThreadTeam& team) {
  if (fresh_.empty()) return;
  fit_tiles(a, b, fresh_, team);
  const CellTiles &of_a = tiles(a), &of_b = tiles(b);
  const CollideKernels& kernels = collide_kernels_for(team.instructions());
  found_.fill(static_cast<int>(fresh_.size()), team, [&](int i, std::vector<CandidateTile>& mine) {
    CandidateTile one = fresh_[i];
    const float moved = motions_[a].distance(of_a.tiling().patch_a(one)) +
                        motions_[b].distance(of_b.tiling().patch_b(one));
    std::array<float, tile_cells> gaps;
    kernels.tile_gaps(of_a.cell(one.row_a, one.col_a), of_b.tile(of_b.tiling().tile_b(one)), 0, 0,
                      gaps.data());
    one.gap = HUGE_VALF;
    for_lanes(one.cells, [&](int lane) {
      if (gaps[lane] - moved > reach + skin_)
        one.cells &= static_cast<std::uint8_t>(~(1U << lane));
      else
        one.gap = std::min(one.gap, gaps[lane] - moved);
    });
    if (one.cells != 0) mine.push_back(one);
  });
  fresh_.clear();
  append(found_, fresh_);
}

void CoherentPairs::merge(int a, int b, int since, std::span<const CandidateTile> fresh,
                          std::vector<CandidateTile>& tiles) {
  const PatchVersions &of_a = versions(a, a == b), &of_b = versions(b, a == b);
  const Tiling &tiling_a = tiles_[static_cast<std::size_t>(a)].tiling(),
               &tiling_b = tiles_[static_cast<std::size_t>(b)].tiling();
  const auto stays = [&](const CandidateTile& one) {
    return of_a.of(tiling_a.patch_a(one)) <= since && of_b.of(tiling_b.patch_b(one)) <= since;
  };
  merged_.clear();
  auto next = fresh.begin();
  for (const CandidateTile& one : tiles) {
    if (!stays(one)) continue;
    for (; next != fresh.end() && place_of(*next, tiling_a) < place_of(one, tiling_a); ++next)
      merged_.push_back(*next);
    merged_.push_back(one);
  }
  merged_.insert(merged_.end(), next, fresh.end());
  // Copied, as buffers that were swapped would have to grow anew.
  tiles.assign(merged_.begin(), merged_.end());
}

void CoherentPairs::collect_near(int a, int b, float reach) {
  const PatchMotion &of_a = motions_[a], &of_b = motions_[b];
  const Tiling &tiling_a = tiles(a).tiling(), &tiling_b = tiles(b).tiling();
  near_.clear();
  for (const CandidateTile& one : list_of(a, b).tiles)
    if (one.gap <=
        reach + of_a.distance(tiling_a.patch_a(one)) + of_b.distance(tiling_b.patch_b(one)))
      near_.push_back(one);
}

std::span<const CandidateTile> CoherentPairs::find(int surface_a, int surface_b, float reach,
                                                   ThreadTeam& team) {
  List& list = list_of(surface_a, surface_b);
  widen(list, reach);
  complete(surface_a, surface_b, list, 0, team);
  collect_near(surface_a, surface_b, reach);
  fit_tiles(surface_a, surface_b, near_, team);
  return near_;
}

void CoherentPairs::find_unfolded(int surface, float slack, ThreadTeam& team) {
  float& found = found_slack_[static_cast<std::size_t>(surface)];
  if (found != slack)
    windows_[static_cast<std::size_t>(surface)].find_unfolded(now_[surface], slack, team);
  found = slack;
}

void CoherentPairs::take_refolded(int surface) {
  PatchVersions& of = self_versions_[static_cast<std::size_t>(surface)];
  const int next = version_ + 1;
  windows_[static_cast<std::size_t>(surface)].for_refolded(
      [&](const Node& first, int span) { of.set_square(first, span, next); });
  if (of.latest() == next) version_ = next;
}

/// What of a cell's pairs is in no rectangle that is unfolded now, and not apart where charts meet
/// in a corner.
CandidateTile CoherentPairs::folded_part(int surface, const CandidateTile& of, float slack) const {
  const UnfoldedWindows& windows = windows_[static_cast<std::size_t>(surface)];
  const Tiling& tiling = tiles(surface).tiling();
  CandidateTile folded = of;
  const int cell = tiling.cell_at(of.row_a, of.col_a);
  for_lanes(of.cells, [&](int lane) {
    const CandidatePair pair{cell, tiling.cell_b(of, lane)};
    if (windows.unfolded(pair) || apart_at_shared_point(now_[surface], pair, slack))
      folded.cells &= static_cast<std::uint8_t>(~(1U << lane));
  });
  return folded;
}

void CoherentPairs::drop_neighbours() {
  std::size_t kept = 0;
  for (CandidateTile one : fresh_) {
    for_lanes(one.cells, [&](int lane) {
      const int row = one.row_b + lane / Tiling::cols, col = one.col_b + lane % Tiling::cols;
      if (std::abs(row - one.row_a) <= UnfoldedWindows::neighbours &&
          std::abs(col - one.col_a) <= UnfoldedWindows::neighbours)
        one.cells &= static_cast<std::uint8_t>(~(1U << lane));
    });
    if (one.cells != 0) fresh_[kept++] = one;
  }
  fresh_.resize(kept);
}

/// Neighbours along the cloth are most of all pairs that are near, and their gaps are of no use:
/// those in folded windows are told anew each time. Unfolded ones are left out also because planes
/// between them would hinder rotation.
std::span<const CandidateTile> CoherentPairs::find_self(int surface, float reach, float slack,
                                                        ThreadTeam& team) {
  find_unfolded(surface, slack, team);
  const UnfoldedWindows& windows = windows_[static_cast<std::size_t>(surface)];
  if (windows.all_unfolded()) return {};
  take_refolded(surface);
  List& list = list_of(surface, surface);
  widen(list, reach);
  complete(surface, surface, list, slack, team);
  collect_near(surface, surface, reach);
  fresh_.clear();
  found_.fill(static_cast<int>(near_.size()), team, [&](int i, std::vector<CandidateTile>& mine) {
    const CandidateTile folded = folded_part(surface, near_[i], slack);
    if (folded.cells != 0) mine.push_back(folded);
  });
  append(found_, fresh_);
  found_.fill(now_[surface].grid->cells(), team, [&](int row, std::vector<CandidateTile>& mine) {
    windows.find_folded_neighbours(*now_[surface].grid, row, mine);
  });
  append(found_, fresh_);
  std::swap(near_, fresh_);
  fit_tiles(surface, surface, near_, team);
  return near_;
}

}  // namespace weft
