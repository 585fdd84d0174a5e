#pragma once

#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/collider.h"
#include "weft/collide/untangle/tangle_marks.h"
#include "weft/contact.h"

namespace weft {

/// Stiffness of a contact between layers whose points have this inverse effective mass [1/kg].
/// [N/m]
[[nodiscard]] float layer_stiffness(double compliance, double time_step);

/// A pair of cloths, or a cloth with itself, for contact search.
struct ClothPair {
  const SurfaceGrid *grid_a = nullptr, *grid_b = nullptr;
  const MovingCloth *a = nullptr, *b = nullptr;
  const CellTiles *tiles_a = nullptr, *tiles_b = nullptr;
  int number_a = 0, number_b = 0;       ///< of the cloths; equal: one and the same
  const Planes3* rest = nullptr;        ///< of a cloth with itself, see CollidingCloth [m]
  double gap = 0;                       ///< that is kept [m]
  double friction = 0;                  ///< of the pair
  double time_step = 0;                 ///< [s]
  bool creases = false;                 ///< whether cells that share a corner get contacts
  const TangleMarks* tangle = nullptr;  ///< where they cross; else null
  [[nodiscard]] bool same() const { return number_a == number_b; }
};

/// Output lists for the contacts of a pair.
struct PairLists {
  std::vector<Contact>&of_a, &of_b;
  std::vector<SharedContact>* shared = nullptr;  ///< null: each cloth gets a half-space
};

/// Finds contacts between parts of cloths that come closer than the contact margin during a step:
/// of samples with triangles, and of edges that cross at an angle, between their closest points at
/// the start of the step. Each belongs to one pair of cells: samples and edges belong to the cell
/// that they begin.
class PairContacts {
 public:
  /// Appends contacts. Those of a cloth with itself go to `of_a` with both sides in them; those of
  /// two cloths are shared, or each cloth gets a half-space that moves with the mean motion of both
  /// sides.
  /// @return whether any cells may come within the contact margin
  bool find(const ClothPair& pair, std::span<const CandidateTile> cells, ThreadTeam& team,
            const PairLists& lists);

 private:
  struct Found {
    std::vector<Contact> of_a, of_b;
    std::vector<SharedContact> shared;
    bool near = false;
    void clear() {
      near = false;
      of_a.clear();
      of_b.clear();
      shared.clear();
    }
  };
  ChunkedLists<Found> found_;
};

}  // namespace weft
