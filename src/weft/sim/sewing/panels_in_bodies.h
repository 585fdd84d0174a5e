#pragma once

#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/mesh/crossings.h"
#include "weft/sim/loading/insides.h"
#include "weft/simulation.h"

namespace weft {

/// Tells which panels of a garment are in bodies, or pass through their surfaces. A body that holds
/// all panels, as a room does, is left out.
class PanelsInBodies {
 public:
  /// @param panels  gives the triangles, by charts; kept by reference
  /// @param placed  where they lie at first [n x n] [m]
  PanelsInBodies(const GeometryImage& panels, std::span<const PlacedBody> bodies,
                 const Planes3& placed);

  /// Of each panel, whether a part of it is inside a closed body or passes through its surface.
  [[nodiscard]] std::vector<bool> find(const Planes3& placed, ThreadTeam& team);
  /// Whether a panel is outside of all closed bodies, and passes through no surface, closed or not.
  [[nodiscard]] bool is_free(int panel, const Planes3& placed) const;
  /// Whether a closed body holds a point. [m]
  [[nodiscard]] bool hold(Vec3d point) const;

 private:
  const BorderMates& mates_;
  std::vector<std::vector<Triangle>> triangles_;  // of each chart
  std::vector<ClosedBody> closed_;
  std::vector<CrossingSurface> closed_skins_;  // of each of them
  std::vector<CrossingSurface> open_skins_;    // of all other bodies
  std::vector<char> inside_;                   // [n * n]
};

}  // namespace weft
