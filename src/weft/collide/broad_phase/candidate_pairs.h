#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/patch_versions.h"
#include "weft/collide/broad_phase/path_boxes.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Contacts are made where features come closer than this many times the gap that is kept.
inline constexpr double contact_margin = 1.5;

/// Two cells (row * (n - 1) + col) that may meet during a step; of one surface with itself a < b.
struct CandidatePair {
  int a = 0, b = 0;
  friend bool operator==(const CandidatePair&, const CandidatePair&) = default;
};

/// A cell of one surface and those of a tile of another that may meet it during a step, see
/// Tiling; of one surface with itself each pair is in one of these.
struct CandidateTile {
  std::uint16_t row_a = 0, col_a = 0;  ///< of the cell
  std::uint16_t row_b = 0, col_b = 0;  ///< of the tile's first cell
  std::uint8_t cells = 0;              ///< bit k: the tile's cell k
  float gap = 0;                       ///< none of these is certainly nearer in the step [m]
  friend bool operator==(const CandidateTile&, const CandidateTile&) = default;
};

class UnfoldedWindows;

/// What of a search is wanted: pairs of patches of which at least one has changed.
struct ChangedPatches {
  const PatchVersions *a = nullptr, *b = nullptr;
  int since = 0;  ///< versions after this are changes
  /// Of a cloth with itself: pairs in its windows above the cells may be left out.
  const UnfoldedWindows* unfolded = nullptr;
};

/// Finds the pairs of cells of surfaces that may meet. Nothing allocates once warmed up.
class BroadPhase {
 public:
  BroadPhase() = default;
  BroadPhase(const BroadPhase&) = delete;
  BroadPhase& operator=(const BroadPhase&) = delete;
  virtual ~BroadPhase() = default;

  /// Fits to the surfaces' motion during a step: cloths first, then bodies, always as many and of
  /// the same sizes.
  virtual void refit(std::span<const MovingSurface> surfaces, ThreadTeam& team) = 0;
  /// Finds all pairs of cells of two surfaces that come closer than `reach` at some time of the
  /// step, each once, and perhaps some that do not, in an order that does not depend on the team.
  /// Pairs that are known not to come so close may be left out.
  virtual void find(int surface_a, int surface_b, float reach, ThreadTeam& team,
                    std::vector<CandidateTile>& out) = 0;
  /// The same for a cloth with itself: all pairs of cells that can meet in more than a common
  /// corner or edge while every sample stays within `slack` of its path. Neighbours in a certainly
  /// unfolded rectangle are left out, though they may be closer than `reach`.
  virtual void find_self(int surface, float reach, float slack, ThreadTeam& team,
                         std::vector<CandidateTile>& out) = 0;
  /// The same as find or find_self, of changed patches alone, ordered by the patches of the first
  /// surface and then by place_in_order of those of the second. A cloth's neighbours along itself
  /// are left out, see UnfoldedWindows::neighbours.
  /// @return false where the phase cannot tell parts of a search from the whole
  virtual bool find_changed(int /*surface_a*/, int /*surface_b*/, float /*reach*/,
                            const ChangedPatches& /*changed*/, ThreadTeam& /*team*/,
                            std::vector<CandidateTile>& /*out*/) {
    return false;
  }
  /// Boxes of the nodes of a surface's mip pyramid in the step; null where there is no pyramid.
  [[nodiscard]] virtual const PathBoxLevels* boxes(int /*surface*/) const { return nullptr; }
};

}  // namespace weft
