#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/broad_phase/unfolded_windows.h"

namespace weft {

/// Pairs of cells that stay valid while surfaces move little, as neighbour lists of particle codes
/// do [verlet67]: they are looked for with a skin around what is asked for, and looked for anew
/// when a sample is farther from where it was then, at the start or at the end of the step, than
/// half of it. When they are asked for again, each is known with how far apart it was, so that
/// those are told that may have come near since. A step asks three to five times for nearly the
/// same; cloth at rest many more.
class CoherentPairs {
 public:
  /// @param cloths  how many of the surfaces, which come first @param skin  [m]
  CoherentPairs(std::unique_ptr<BroadPhase> broad_phase,
                std::span<const SurfaceGrid* const> surfaces, std::size_t cloths, float skin);

  /// Takes the surfaces' motion during a step, as BroadPhase::refit.
  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team);
  /// As of BroadPhase, and perhaps some that come closer by the skin only; valid until the next
  /// call.
  std::span<const CandidatePair> find(int surface_a, int surface_b, float reach, ThreadTeam& team);
  /// The same; neighbours whose rectangle is certainly unfolded now are left out.
  std::span<const CandidatePair> find_self(int surface, float reach, float slack, ThreadTeam& team);
  /// Where nodes of a surface's mip pyramid are, within skin(); null where there is no pyramid.
  [[nodiscard]] const PathBoxLevels* boxes(int surface) const {
    return broad_phase_->boxes(surface);
  }
  [[nodiscard]] float skin() const { return skin_; }
  /// What follows depends on what it is given alone.
  void forget();

 private:
  /// Where a surface was when pairs were looked for.
  struct Snapshot {
    Planes3 start, end;
    int name = 0;
    bool still = false;  // end is the start
    float distance = 0;  // of the surface from there [m]
  };
  static constexpr std::size_t buckets = 16;
  struct Found {
    CandidatePair cells;
    int bucket = 0;
  };
  /// Pairs of two surfaces; once sorted, ordered by how far apart they are, in so many steps.
  struct List {
    bool known = false, sorted = false;
    float reach = 0, slack = 0;  // the most that was asked for
    std::vector<CandidatePair> cells;
    std::array<std::size_t, buckets> ends{};
    std::vector<CandidatePair> smooth;  // neighbours whose rectangle was unfolded, in any order
  };
  /// How far a surface is from its snapshot at most; infinite: farther than lists hold for.
  [[nodiscard]] float distance_from(const Snapshot& snapshot, const MovingSurface& now) const;
  void take(std::span<const MovingSurface> surfaces, ThreadTeam& team);
  List& list_of(int a, int b) {
    return lists_[static_cast<std::size_t>(a) * snapshots_.size() + b];
  }
  /// Of the pairs that were found, whose boxes came near, keeps those whose cells did.
  void sort(int a, int b, List& list, ThreadTeam& team);
  static void order(const ChunkedLists<std::vector<Found>>& found, List& list);
  void find_unfolded(int surface, float slack, ThreadTeam& team);
  void set_smooth_aside(int surface, List& list);
  /// Those that may come so near now.
  std::span<const CandidatePair> nearest(int a, int b, float reach, ThreadTeam& team);

  std::unique_ptr<BroadPhase> broad_phase_;
  float skin_;
  std::vector<Snapshot> snapshots_;
  std::vector<MovingSurface> placed_, now_;  // as they were, and are
  std::vector<UnfoldedWindows> windows_;     // of each cloth, now
  std::vector<float> found_slack_;  // of each cloth, the slack its folds were found with; -1: not
  SharedPairs shared_;
  std::vector<CandidatePair> folded_;
  std::vector<List> lists_;  // [surfaces x surfaces]
  ChunkedLists<std::vector<Found>> near_;
  bool known_ = false;
};

}  // namespace weft
