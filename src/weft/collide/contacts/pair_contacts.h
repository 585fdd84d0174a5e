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
  /// Whether seams are being sewn: contacts at ridges and creases would keep them open.
  [[nodiscard]] bool is_sewn() const { return grid_a->is_sewn() || grid_b->is_sewn(); }
};

/// The patches of both sides of a contact.
struct ContactPatches {
  int a = 0, b = 0;
};

/// The contacts of a pair. Those of a cloth with itself are in `of_a` with both sides in them;
/// those of two cloths are shared, or each cloth has a half-space that moves with the mean motion
/// of both sides.
struct PairFound {
  std::vector<Contact> of_a, of_b;
  std::vector<SharedContact> shared;
  std::vector<ContactPatches> patches;  ///< one for each contact of the lists that have any
  bool near = false;                    ///< whether any cells may come within the contact margin
  void clear();
  void append(const PairFound& other);
};

/// Marks of patches, of both cloths of a pair.
struct MovedPatches {
  std::span<const char> a, b;
};

/// Finds contacts between parts of cloths that come closer than the contact margin during a step,
/// between their closest points at the start of the step: of samples with triangles, and with the
/// edges and vertices beyond which they lie, and of edges that cross at an angle. Each belongs to
/// one pair of cells, see CellFeatures.
class PairContacts {
 public:
  /// @param share  whether contacts of two cloths are shared
  void find(const ClothPair& pair, std::span<const CandidateTile> cells, bool share,
            ThreadTeam& team);
  /// Finds contacts anew that have a moved patch, and keeps the others.
  void find_again(const ClothPair& pair, std::span<const CandidateTile> cells,
                  const MovedPatches& moved, bool share, ThreadTeam& team);
  [[nodiscard]] const PairFound& found() const { return found_; }

 private:
  void keep_unmoved(const MovedPatches& moved);

  PairFound found_;
  ChunkedLists<PairFound> parts_;
};

}  // namespace weft
