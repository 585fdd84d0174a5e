#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/broad_phase/unfolded_windows.h"

namespace weft {

/// Cache of candidate pairs that stay valid while surfaces move little, as neighbour lists of
/// particle codes do [verlet67]. Pairs are searched with a skin around the reach, and searched anew
/// when the start or the end of a sample has moved by more than half the skin since. Repeated
/// queries keep the pairs' gaps, so that only pairs that may have come near since are returned. A
/// step asks three to five times for nearly the same pairs; cloth at rest many more.
class CoherentPairs {
 public:
  /// @param cloths  number of cloths among the surfaces, which come first
  /// @param skin  [m]
  CoherentPairs(std::unique_ptr<BroadPhase> broad_phase,
                std::span<const SurfaceGrid* const> surfaces, std::size_t cloths, float skin);

  /// Takes the surfaces' motion during a step, as BroadPhase::refit.
  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team);
  /// Pairs as of BroadPhase::find, and perhaps some within the skin beyond `reach`; valid until the
  /// next call.
  std::span<const CandidatePair> find(int surface_a, int surface_b, float reach, ThreadTeam& team);
  /// The same for a cloth with itself; neighbours in a now certainly unfolded rectangle are left
  /// out.
  std::span<const CandidatePair> find_self(int surface, float reach, float slack, ThreadTeam& team);
  /// Boxes of the nodes of a surface's mip pyramid, accurate to skin(); null where there is no
  /// pyramid.
  [[nodiscard]] const PathBoxLevels* boxes(int surface) const {
    return broad_phase_->boxes(surface);
  }
  [[nodiscard]] float skin() const { return skin_; }
  /// Drops all cached pairs: what follows depends on its input alone.
  void forget();

 private:
  /// Positions of a surface when pairs were last searched.
  struct Snapshot {
    Planes3 start, end;
    int name = 0;
    bool still = false;  // end is the start
    float distance = 0;  // of the surface's samples from here, the largest [m]
  };
  static constexpr std::size_t buckets = 16;
  struct Found {
    CandidatePair cells;
    int bucket = 0;
  };
  /// Pairs of two surfaces; once sorted, in buckets by their gaps.
  struct List {
    bool known = false, sorted = false;
    float reach = 0, slack = 0;  // largest that were asked for
    std::vector<CandidatePair> cells;
    std::array<std::size_t, buckets> ends{};
    std::vector<CandidatePair> smooth;  // neighbours whose rectangle was unfolded, in any order
  };
  /// Largest displacement of a surface from its snapshot; infinite where it exceeds half the skin.
  [[nodiscard]] float distance_from(const Snapshot& snapshot, const MovingSurface& now) const;
  void remember(std::span<const MovingSurface> surfaces, ThreadTeam& team);
  List& list_of(int a, int b) {
    return lists_[static_cast<std::size_t>(a) * snapshots_.size() + b];
  }
  /// Keeps those of the pairs with near boxes whose cells are near, in buckets by their gaps.
  void sort(int a, int b, List& list, ThreadTeam& team);
  static void order(const ChunkedLists<std::vector<Found>>& found, List& list);
  void find_unfolded(int surface, float slack, ThreadTeam& team);
  void set_smooth_aside(int surface, List& list);
  /// Cached pairs that may come closer than `reach` now.
  std::span<const CandidatePair> nearest(int a, int b, float reach, ThreadTeam& team);

  std::unique_ptr<BroadPhase> broad_phase_;
  float skin_;
  std::vector<Snapshot> snapshots_;
  std::vector<MovingSurface> placed_, now_;  // at the last search, and now
  std::vector<UnfoldedWindows> windows_;     // of each cloth, now
  std::vector<float> found_slack_;           // per cloth, the slack of its windows; -1: none
  SharedPairs shared_;
  std::vector<CandidatePair> folded_;
  std::vector<List> lists_;  // [surfaces x surfaces]
  ChunkedLists<std::vector<Found>> near_;
  bool known_ = false;
};

}  // namespace weft
