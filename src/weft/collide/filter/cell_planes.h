#pragma once

#include <span>
#include <vector>

#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/contacts/body_contacts.h"
#include "weft/collide/contacts/body_crossings.h"
#include "weft/collide/filter/separating_planes.h"
#include "weft/collide/untangle/tangle_marks.h"
#include "weft/core/thread_team.h"

namespace weft {

/// One surface of a search for separating planes.
struct PlaneSide {
  MovingSurface surface;
  const CellTiles* tiles = nullptr;
  int first_point = 0;  ///< number of its sample 0 among all cloths' samples
  bool body = false;
  const Planes3* safe_position = nullptr;  ///< of its samples, see SafePositions [n x n] [m]
  /// Per cell, whether the end of a corner has changed; null: none has. [(n - 1)^2]
  const char* new_cells = nullptr;
};

/// A search for separating planes between two surfaces.
struct PlaneSearch {
  PlaneSide a, b;
  bool same = false;
  PlaneOptions options;
  const InsideMarks* inside = nullptr;  ///< inside marks of a, where b is a body
  int body_number = 0;                  ///< triangles of a with a sample marked by it get no plane
  const BodyCrossings* crossings = nullptr;  ///< of a, where b is a body: those get no plane either
  std::span<const char> buried{};            ///< see ContactBody; those of b get no plane
  const TangleMarks* tangle = nullptr;       ///< marks of cloths that cross; else null
  /// Per point of all cloths, whether its end has changed: only pairs of triangles with such a
  /// corner are searched; null: all are.
  const char* new_points = nullptr;
};

/// Finds separating planes between the triangles of candidate cell pairs: of triangles that share
/// no point; of those that share one, between each and the other's opposite edge. Triangles that
/// share an edge cannot cross.
class CellPlanes {
 public:
  /// Appends the planes to `out`, in an order that does not depend on the team. Features that meet
  /// at the start of the step get no plane, as none separates them.
  void find(const PlaneSearch& search, std::span<const CandidateTile> cells, ThreadTeam& team,
            std::vector<SeparatingPlane>& out);

 private:
  ChunkedLists<std::vector<SeparatingPlane>> found_;
};

}  // namespace weft
