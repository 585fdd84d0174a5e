#pragma once

#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/collider.h"
#include "weft/collide/untangle/tangle_marks.h"
#include "weft/contact.h"

namespace weft {

/// What a pair of surfaces is to contacts: both are cloths, perhaps one and the same.
struct ClothPair {
  const SurfaceGrid *grid_a = nullptr, *grid_b = nullptr;
  const MovingCloth *a = nullptr, *b = nullptr;
  int number_a = 0, number_b = 0;       ///< of the cloths; equal: one and the same
  const Planes3* rest = nullptr;        ///< of one and the same, see CollidingCloth [m]
  double gap = 0;                       ///< that is kept [m]
  double friction = 0;                  ///< of the pair
  double time_step = 0;                 ///< [s]
  bool creases = false;                 ///< whether cells that share a corner press, too
  const TangleMarks* tangle = nullptr;  ///< where they cross; else null
  [[nodiscard]] bool same() const { return number_a == number_b; }
};

/// Where contacts of a pair go.
struct PairLists {
  std::vector<Contact>&of_a, &of_b;
  std::vector<SharedContact>* shared = nullptr;  ///< null: each cloth gets its own side
};

/// Contacts between parts of cloths that come closer than their gap during a step: samples and
/// triangles, and edges that cross at an angle, as they were closest at the start of the step. Each
/// belongs to one pair of cells: a sample to the cell that it begins, and so does an edge.
class PairContacts {
 public:
  /// Contacts of a cloth with itself go to `of_a` with both sides in them; of two cloths they are
  /// shared, or each gets its own side, against a plane that moves as both do on the mean.
  void find(const ClothPair& pair, std::span<const CandidatePair> cells, ThreadTeam& team,
            const PairLists& lists);

 private:
  struct Found {
    std::vector<Contact> of_a, of_b;
    std::vector<SharedContact> shared;
    void clear() {
      of_a.clear();
      of_b.clear();
      shared.clear();
    }
  };
  ChunkedLists<Found> found_;
};

}  // namespace weft
