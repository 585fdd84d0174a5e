#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/collide/untangle/intersection_contours.h"
#include "weft/collide/untangle/regions.h"
#include "weft/collide/untangle/smooth_move.h"
#include "weft/collide/untangle/tangle_marks.h"

namespace weft {

/// Takes cloths apart that start through each other or themselves. At the start of each step it
/// finds the curves in which they cut each other, decides for each which way the layers have to
/// move relative to each other for it to shrink [volino06, baraff03], and at the end of the step
/// moves what is around it a little that way, without speeding it up. Pairs of cloths that are
/// free stay so and cost nothing.
class Untangler {
 public:
  /// @param grids  of the cloths, kept by reference
  void set_up(std::span<const SurfaceGrid* const> grids,
              std::span<const CollidingCloth> properties);

  /// Whether a pair may be tangled. @pre a <= b
  [[nodiscard]] bool is_open(std::size_t a, std::size_t b) const { return pair(a, b).open; }
  void set_open(std::size_t a, std::size_t b, bool open) { pair(a, b).open = open; }
  /// Finds what crosses at the start of a step; closes the pair where nothing does.
  /// @param cells  all that may meet
  void find_crossings(std::size_t a, std::size_t b, std::span<const MovingCloth> cloths,
                      std::span<const CandidatePair> cells, ThreadTeam& team);
  /// Of a pair that the last look found tangled; else null.
  [[nodiscard]] const TangleMarks* marks(std::size_t a, std::size_t b) const {
    return pair(a, b).crossings > 0 ? &pair(a, b).marks : nullptr;
  }
  /// Changes proposals so that the curves shrink. Mates stay as they are but for the first of each.
  void move(std::span<const MovingCloth> cloths, double time_step);
  /// Edges through triangles that the last looks found.
  [[nodiscard]] int crossings() const;

 private:
  /// What is known of a curve.
  struct Verdict {
    std::array<double, 2> turns{};    // of each layer: along the other's normal, which way is out
    std::array<int, 2> sizes{};       // samples of the least part that it cuts off
    double alike = 0;                 // whether their normals agree
    int first_side = 0;               // which of the pair's the first layer is
    std::array<int, 2> edges{};       // crossings whose edge is of each layer
    std::array<int, 2> cutting{};     // of these, how many lead from one part to another
    Vec3d shorter;                    // the first layer's way that shortens it, see Frame::axes
    Vec3d scatter;                    // sums of its terms' squares
    std::array<double, 2> settled{};  // turns, 1, 0 or -1
    [[nodiscard]] bool is_settled() const { return settled[0] != 0 || settled[1] != 0; }
  };
  /// How a crossing's layers are to move.
  struct Way {
    Vec3d apart;        // the edge against the triangle; unit or zero
    double amount = 0;  // [m]
    double weight = 1;  // beside others
  };
  struct Pair {
    bool open = true;
    int crossings = 0;
    IntersectionContours contours;
    TangleMarks marks;
    std::vector<Way> ways;  // of the nodes
  };
  /// Normals at a crossing by the contour's layers.
  struct Frame {
    std::array<Vec3d, 2> normals;
    /// Along the contour, across it in the second layer, and along that one's normal.
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
  /// On which side of the second cloth the first lies mostly where they lie on each other: from 1,
  /// the side that normals point to, to -1; 0 where that is not known.
  [[nodiscard]] static double lying(const StandingPair& standing,
                                    std::span<const CandidatePair> cells, double reach);
  /// What lies through each other without one part being cut off goes to the side where more is.
  void add_lying(double side);
  void vote(const StandingPair& standing, const ContourNode& node, Verdict& verdict) const;
  void mark(const StandingPair& standing, Pair& pair);
  void find_ways(const StandingPair& standing, double most, double margin, Pair& pair);
  [[nodiscard]] Vec3d direction(const StandingPair& standing, const ContourNode& node) const;
  /// The first layer's way against the second that shortens the contour most at a node.
  static Vec3d shortening(const StandingPair& standing, const ContourNode& node);
  static Frame frame_of(const StandingPair& standing, const ContourNode& node);
  void want(const ContourNode& node, const Way& displacement, std::array<std::size_t, 2> of,
            std::span<const MovingCloth> cloths);

  std::vector<const SurfaceGrid*> grids_;
  std::vector<CollidingCloth> properties_;
  std::vector<Pair> pairs_;                 // [cloths x cloths], those with a <= b in use
  std::vector<SmoothMove> pushes_, holds_;  // of each cloth
  // Of the pair that is looked at:
  std::array<Regions, 2> regions_;
  std::vector<CutEdge> cuts_;
  std::vector<Verdict> verdicts_;
  std::vector<char> wrong_regions_;
};

}  // namespace weft
