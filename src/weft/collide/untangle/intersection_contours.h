#pragma once

#include <array>
#include <compare>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/cell_tiles.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/disjoint_sets.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Two cloths, or a cloth with itself, at the start of a step.
struct StandingPair {
  std::array<const SurfaceGrid*, 2> grids{};
  std::array<const Planes3*, 2> positions{};  ///< [n x n] [m]
  bool same = false;

  [[nodiscard]] Vec3d at(int side, int sample) const {
    return vec_cast<double>(positions[static_cast<std::size_t>(side)]->at(sample));
  }
  /// Normal of a triangle, towards where its corners turn counter-clockwise. Unit, or zero.
  [[nodiscard]] Vec3d normal(int side, const std::array<int, 3>& triangle) const;
};

/// An edge that passes through a triangle; samples are representatives of their classes.
struct Crossing {
  int side = 0;                   ///< side of the pair that has the edge; of a cloth with itself 0
  std::array<int, 2> edge{};      ///< samples, ascending
  std::array<int, 3> triangle{};  ///< of the other side
  friend auto operator<=>(const Crossing&, const Crossing&) = default;
};

/// A vertex of an intersection contour: a crossing of an edge of one layer with a triangle of the
/// other.
struct ContourNode {
  Crossing crossing;
  std::array<int, 3> own{};  ///< a triangle that the edge bounds
  Vec3d point;               ///< of the crossing [m]
  int contour = 0;           ///< number of its contour, from 0
  int layer = 0;             ///< which of the contour's two layers has the edge, 0 or 1
  int segments = 0;          ///< number of segments that begin here; 1 at a border
  Vec3d onwards;             ///< sum of the segments' unit directions
  /// Side of the pair that has the triangle.
  [[nodiscard]] int triangle_side(bool same) const { return same ? 0 : 1 - crossing.side; }
};

/// Finds the intersection contours of surfaces. A segment of a contour is where two triangles meet;
/// its ends are crossings of an edge of one with the other.
class IntersectionContours {
 public:
  /// @param cells  all candidate pairs; their order does not matter
  void find(const StandingPair& pair, std::span<const CandidateTile> cells, ThreadTeam& team);
  [[nodiscard]] std::span<const ContourNode> nodes() const { return nodes_; }
  [[nodiscard]] int count() const { return contours_; }

 private:
  struct SegmentEnd {
    Crossing crossing;
    std::array<int, 3> own{};
    bool of_first = true;  // the edge is of the segment's first triangle
  };
  /// Intersection of two triangles; it has one end where they share a corner.
  struct Segment {
    std::array<SegmentEnd, 2> ends;
    int count = 0;
    void add(const SegmentEnd& end) {
      if (count < 2) ends[static_cast<std::size_t>(count++)] = end;
    }
  };
  static void find_segments(const StandingPair& pair, const CandidatePair& cells,
                            std::vector<Segment>& out);
  static void cross(const StandingPair& pair, const SegmentEnd& edge, Segment& out);
  void collect_nodes(const StandingPair& pair);
  void join();
  void name_contours();
  [[nodiscard]] int node_of(const Crossing& crossing) const;

  ChunkedLists<std::vector<Segment>> found_;
  std::vector<Segment> segments_;
  std::vector<ContourNode> nodes_;
  DisjointSets sets_;  // of nodes; parities tell whether layers are swapped
  std::vector<int> names_;
  int contours_ = 0;
};

/// An edge by its representative samples, ascending.
using CutEdge = std::array<int, 2>;

/// Connected regions of a sheet whose edges are partly cut.
class Regions {
 public:
  /// @param cut  ascending; an edge that is there twice is not cut
  void find(const SurfaceGrid& grid, std::span<const CutEdge> cut);
  /// Region of a representative sample, named by the region's least sample.
  [[nodiscard]] int of(int sample) const { return roots_[sample]; }
  /// Number of representative samples in a region.
  [[nodiscard]] int size(int region) const { return sizes_[region]; }

 private:
  DisjointSets sets_;               // of samples
  std::vector<int> roots_, sizes_;  // [n * n]
  std::vector<char> touched_;       // [n * n] whether cut edges begin there
};

}  // namespace weft
