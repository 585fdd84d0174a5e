#pragma once

#include <array>
#include <compare>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/candidate_pairs.h"
#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/disjoint_sets.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Two cloths, or one and itself, as they stand at the start of a step.
struct StandingPair {
  std::array<const SurfaceGrid*, 2> grids{};
  std::array<const Planes3*, 2> positions{};  ///< [n x n] [m]
  bool same = false;

  [[nodiscard]] Vec3d at(int side, int sample) const {
    return vec_cast<double>(positions[static_cast<std::size_t>(side)]->at(sample));
  }
  /// Across a triangle, towards where its corners turn counter-clockwise. Unit, or zero.
  [[nodiscard]] Vec3d normal(int side, const std::array<int, 3>& triangle) const;
};

/// An edge that passes through a triangle; samples stand for their classes.
struct Crossing {
  int side = 0;                   ///< of the pair, whose the edge is; of one cloth with itself 0
  std::array<int, 2> edge{};      ///< samples, ascending
  std::array<int, 3> triangle{};  ///< of the other side
  friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

/// A crossing as a corner of the curve in which two layers cut each other.
struct ContourNode {
  Crossing crossing;
  std::array<int, 3> own{};  ///< a triangle that the edge bounds
  Vec3d point;               ///< where [m]
  int contour = 0;           ///< which of the curves, from 0
  int layer = 0;             ///< which of the curve's two layers the edge belongs to
  int segments = 0;          ///< how many pieces of the curve begin here; 1 at a border
  Vec3d onwards;             ///< sum of their directions, each unit
  /// Of a pair, whose the triangle is.
  [[nodiscard]] int triangle_side(bool same) const { return same ? 0 : 1 - crossing.side; }
};

/// Finds the curves in which surfaces cut each other. A piece of a curve is where two triangles
/// meet; its ends are edges of the one in the other.
class IntersectionContours {
 public:
  /// @param cells  all pairs that may meet. In what order, changes nothing.
  void find(const StandingPair& pair, std::span<const CandidatePair> cells, ThreadTeam& team);
  [[nodiscard]] std::span<const ContourNode> nodes() const { return nodes_; }
  [[nodiscard]] int count() const { return contours_; }

 private:
  struct SegmentEnd {
    Crossing crossing;
    std::array<int, 3> own{};
    bool of_first = true;  // the edge is of the segment's first triangle
  };
  /// Where two triangles meet; one end where they share a corner.
  struct Segment {
    std::array<SegmentEnd, 2> ends;
    int count = 0;
    void add(const SegmentEnd& end) {
      if (count < 2) ends[static_cast<std::size_t>(count++)] = end;
    }
  };
  static void look_at(const StandingPair& pair, const CandidatePair& cells,
                      std::vector<Segment>& out);
  static void cross(const StandingPair& pair, const SegmentEnd& edge, Segment& out);
  void collect_nodes(const StandingPair& pair);
  void join();
  void name_contours();
  [[nodiscard]] int node_of(const Crossing& crossing) const;
  /// The node that stands for one's contour; layers become relative to it.

  ChunkedLists<std::vector<Segment>> found_;
  std::vector<Segment> segments_;
  std::vector<ContourNode> nodes_;
  DisjointSets sets_;  // of nodes; parities tell whether layers swap on the way
  std::vector<int> names_;
  int contours_ = 0;
};

}  // namespace weft
