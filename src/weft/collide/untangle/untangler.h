#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/collide/untangle/intersection_contours.h"
#include "weft/collide/untangle/smooth_move.h"
#include "weft/collide/untangle/tangle_marks.h"

namespace weft {

/// Untangles cloths that start through each other or themselves. At the start of each step it finds
/// the intersection contours and chooses for each the relative displacement of its layers that
/// shrinks it [volino06, baraff03]; at the end of the step it moves the samples around it a little
/// that way, without speeding them up. Pairs of cloths without crossings stay so and cost nothing.
class Untangler {
 public:
  /// @param grids  of the cloths, kept by reference
  void set_up(std::span<const SurfaceGrid* const> grids,
              std::span<const CollidingCloth> properties);

  /// Whether a pair may be tangled. @pre a <= b
  [[nodiscard]] bool is_open(std::size_t a, std::size_t b) const { return pair(a, b).open; }
  void set_open(std::size_t a, std::size_t b, bool open) { pair(a, b).open = open; }
  /// Finds the crossings of a pair at the start of a step; closes the pair where there are none.
  /// @param cells  all candidate pairs
  void find_crossings(std::size_t a, std::size_t b, std::span<const MovingCloth> cloths,
                      std::span<const CandidateTile> cells, ThreadTeam& team);
  /// Marks of a pair that the last find_crossings found tangled; else null.
  [[nodiscard]] const TangleMarks* marks(std::size_t a, std::size_t b) const {
    return pair(a, b).crossings > 0 ? &pair(a, b).marks : nullptr;
  }
  /// Moves proposals so that the contours shrink. Only the representative of a class is moved;
  /// copying to mates is left to the caller.
  void move(std::span<const MovingCloth> cloths, double time_step);
  /// Number of edges through triangles in all pairs, as last found.
  [[nodiscard]] int crossings() const;

 private:
  /// Votes on the direction in which a contour's layers have to move, and the choice.
  struct Verdict {
    std::array<double, 2> turns{};  // per layer: votes for its sign along the other's normal
    std::array<int, 2> sizes{};     // per layer: samples of the smallest region cut off
    double alike = 0;               // sum of the dot products of the layers' normals
    int first_side = 0;             // side of the pair that has the first layer
    std::array<int, 2> edges{};     // per layer: crossings by its edges
    std::array<int, 2> cutting{};   // of these, by edges between two regions
    Vec3d shorter;  // displacement of the first layer that shortens it, by Frame::axes
    Vec3d scatter;  // sums of its terms' squares
    std::array<double, 2> settled{};  // per layer: the sign chosen, 1, 0 or -1
    [[nodiscard]] bool is_settled() const { return settled[0] != 0 || settled[1] != 0; }
  };
  /// Relative displacement of the two layers at a crossing.
  struct Way {
    Vec3d apart;        // direction of the edge against the triangle; unit or zero
    double amount = 0;  // [m]
    double weight = 1;  // relative to other crossings
  };
  struct Pair {
    bool open = true;
    int crossings = 0;
    IntersectionContours contours;
    TangleMarks marks;
    std::vector<Way> ways;  // per node of the contours
  };
  /// Normals of the contour's two layers at a crossing.
  struct Frame {
    std::array<Vec3d, 2> normals;
    /// Axes: along the contour, across it in the second layer, and along that layer's normal.
    [[nodiscard]] std::array<Vec3d, 3> axes() const {
      const Vec3d along = normalized(cross(normals[0], normals[1]));
      return {along, cross(normals[1], along), normals[1]};
    }
  };

  [[nodiscard]] std::size_t index(std::size_t a, std::size_t b) const {
    return a * grids_.size() + b;
  }
  [[nodiscard]] const Pair& pair(std::size_t a, std::size_t b) const { return pairs_[index(a, b)]; }
  Pair& pair(std::size_t a, std::size_t b) { return pairs_[index(a, b)]; }

  void find_regions(const StandingPair& standing, const Pair& pair);
  void choose_directions(const StandingPair& standing, const Pair& pair);
  /// Side of the second cloth on which most of the first lies where they rest on each other: from
  /// 1, where normals point to, to -1; 0 where it is unknown.
  [[nodiscard]] static double lying(const StandingPair& standing,
                                    std::span<const CandidateTile> cells, double reach);
  /// The side on which a cell of the first cloth begins over one of the second: 1, -1, or 0 where
  /// it does not.
  [[nodiscard]] static int side_of(const StandingPair& standing, const CandidatePair& cells,
                                   double reach);
  /// Chooses the direction of contours that cut no region off, by the side that `lying` found.
  void add_lying(double side);
  void vote(const StandingPair& standing, const ContourNode& node, Verdict& verdict) const;
  void mark(const StandingPair& standing, Pair& pair);
  void find_ways(const StandingPair& standing, double max, double margin, Pair& pair);
  [[nodiscard]] Vec3d direction(const StandingPair& standing, const ContourNode& node) const;
  /// Displacement of the first layer relative to the second that shortens the contour most at a
  /// node.
  static Vec3d shortening(const StandingPair& standing, const ContourNode& node);
  static Frame frame_of(const StandingPair& standing, const ContourNode& node);
  void want(const ContourNode& node, const Way& displacement, std::array<std::size_t, 2> of,
            std::span<const MovingCloth> cloths);

  std::vector<const SurfaceGrid*> grids_;
  std::vector<CollidingCloth> properties_;
  std::vector<Pair> pairs_;                 // [cloths x cloths], those with a <= b in use
  std::vector<SmoothMove> pushes_, holds_;  // of each cloth
  // Scratch of the current pair:
  std::array<Regions, 2> regions_;
  std::vector<CutEdge> cuts_;
  std::vector<Verdict> verdicts_;
  std::vector<char> wrong_regions_;
};

}  // namespace weft
