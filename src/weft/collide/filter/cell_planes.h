#pragma once

#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/contacts/body_contacts.h"
#include "weft/collide/filter/separating_planes.h"
#include "weft/collide/untangle/tangle_marks.h"
#include "weft/core/thread_team.h"

namespace weft {

/// A surface as planes are looked for.
struct PlaneSide {
  MovingSurface surface;
  int first_point = 0;  ///< number of its sample 0 among all cloths' samples
  bool body = false;
  const Planes3* safe_position = nullptr;  ///< of its samples, see MovingFeature [n x n] [m]
  /// Of its cells, whether a corner's end is new; null: none is. [(n - 1)^2]
  const char* new_cells = nullptr;
};

/// What is looked at together.
struct PlaneSearch {
  PlaneSide a, b;
  bool same = false;
  PlaneOptions options;
  const InsideMarks* inside = nullptr;  ///< of a, where b is a body
  int body_number = 0;                  ///< samples of a marked with it are not kept out
  const TangleMarks* tangle = nullptr;  ///< of two cloths that cross; else null
  /// Of all cloths' points, whether their ends are new: only triangles with such a corner are
  /// looked at; null: all are.
  const char* new_points = nullptr;
};

/// Planes between the triangles of pairs of cells: whole triangles that share no point; of those
/// that share one, each with the other's far edge. Triangles that share an edge cannot cross.
class CellPlanes {
 public:
  /// Adds to `out`, in an order that does not depend on the team. Features that meet at the start
  /// of the step get no plane: nothing can be put between them.
  void find(const PlaneSearch& search, std::span<const CandidatePair> cells, ThreadTeam& team,
            std::vector<SeparatingPlane>& out);

 private:
  ChunkedLists<std::vector<SeparatingPlane>> found_;
};

}  // namespace weft
