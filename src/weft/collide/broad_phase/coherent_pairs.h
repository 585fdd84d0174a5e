#pragma once

#include <memory>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/broad_phase/patch_motion.h"
#include "weft/collide/broad_phase/unfolded_windows.h"

namespace weft {

/// Cache of candidate pairs that stay valid while surfaces move little, as neighbour lists of
/// particle codes do [verlet67]. Pairs are searched with a skin around the reach. A patch that
/// moved by more than half the skin is renewed: its pairs are searched anew, those of others stay.
/// So are those of a cloth's patches with itself where a window that was unfolded no longer is.
/// What was found is kept with its gap, so that queries return only what may have come near since.
/// Lists are in an order that does not depend on when their parts were found.
class CoherentPairs {
 public:
  /// @param cloths  number of cloths among the surfaces, which come first
  /// @param skin  [m]
  CoherentPairs(std::unique_ptr<BroadPhase> broad_phase,
                std::span<const SurfaceGrid* const> surfaces, std::size_t cloths, float skin);

  /// Takes the surfaces' motion during a step, as BroadPhase::refit.
  void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team);
  /// Pairs of cells that may come closer than `reach` during the step, in an order that does not
  /// depend on the team; perhaps some within the skin beyond, which depend on earlier queries.
  /// Valid until the next call.
  std::span<const CandidateTile> find(int surface_a, int surface_b, float reach, ThreadTeam& team);
  /// The same for a cloth with itself; neighbours in a now certainly unfolded rectangle are left
  /// out.
  std::span<const CandidateTile> find_self(int surface, float reach, float slack, ThreadTeam& team);
  /// The corners now of those cells of a surface that pairs were found of.
  [[nodiscard]] const CellTiles& tiles(int surface) const {
    return tiles_[static_cast<std::size_t>(surface)];
  }
  /// Boxes of the nodes of a surface's mip pyramid, accurate to skin(); null where there is no
  /// pyramid.
  [[nodiscard]] const PathBoxLevels* boxes(int surface, ThreadTeam& team);
  [[nodiscard]] float skin() const { return skin_; }
  /// Drops all cached pairs: what follows depends on its input alone.
  void forget();

 private:
  /// Pairs of two surfaces.
  struct List {
    float reach = 0;   // largest that was asked for
    int version = -1;  // of patches, up to which it is complete
    std::vector<CandidateTile> tiles;
  };
  List& list_of(int a, int b) { return lists_[static_cast<std::size_t>(a) * motions_.size() + b]; }
  /// What changes pairs of a surface with itself, or with others.
  [[nodiscard]] const PatchVersions& versions(int surface, bool self) const {
    return self ? self_versions_[static_cast<std::size_t>(surface)] : motions_[surface].versions();
  }
  /// Drops a list that is of a smaller reach.
  static void widen(List& list, float reach);
  /// Searches what a list lacks.
  /// @param slack  of a cloth with itself
  void complete(int a, int b, List& list, float slack, ThreadTeam& team);
  void fit_boxes(ThreadTeam& team);
  void fit_tiles(int a, int b, std::span<const CandidateTile> of, ThreadTeam& team);
  /// Searches what changed since a list was completed, into fresh_.
  /// @return whether that is all of the list
  bool search(int a, int b, const List& list, float slack, ThreadTeam& team);
  /// Drops cells of fresh_ that are certainly apart; what is left has its gaps.
  void refine(int a, int b, float reach, ThreadTeam& team);
  /// Replaces what of a list has changed by fresh pairs.
  void merge(int a, int b, int since, std::span<const CandidateTile> fresh,
             std::vector<CandidateTile>& tiles);
  void find_unfolded(int surface, float slack, ThreadTeam& team);
  /// Changes a cloth's patches in windows that are no longer unfolded.
  void take_refolded(int surface);
  [[nodiscard]] CandidateTile folded_part(int surface, const CandidateTile& of, float slack) const;
  /// Drops neighbours along a cloth from fresh_: which of them are folded is told by windows.
  void drop_neighbours();
  /// Fills near_ with those pairs of a list that may come closer than `reach` now.
  void collect_near(int a, int b, float reach);

  std::unique_ptr<BroadPhase> broad_phase_;
  float skin_;
  std::vector<MovingSurface> now_;
  std::vector<int> names_;  // of the motions that were measured last
  std::vector<PatchMotion> motions_;
  std::vector<PatchVersions> self_versions_;  // of each cloth
  std::vector<CellTiles> tiles_;              // now
  std::vector<UnfoldedWindows> windows_;      // of each cloth, now
  std::vector<float> found_slack_;            // per cloth, the slack of its windows; -1: none
  std::vector<CandidateTile> near_, fresh_, merged_;
  std::vector<List> lists_;  // [surfaces x surfaces]
  ChunkedLists<std::vector<CandidateTile>> found_;
  int version_ = 0;           // of patches that are renewed now
  bool boxes_fit_ = false;    // whether the broad phase has the surfaces as they are now
  bool boxes_known_ = false;  // whether its boxes are accurate to the skin
};

}  // namespace weft
