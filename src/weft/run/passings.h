#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/mesh/box_tree.h"
#include "weft/simulation.h"

namespace weft {

/// A moving triangulated surface in a continuous collision check.
class PassingSurface {
 public:
  /// @param start  positions for which the tree is built [n x n] [m]
  /// @param sewn  the mates that are sewn together in the run; null: none
  PassingSurface(const GeometryImage& image, const Planes3& start, const BorderMates* sewn);
  /// Sets the motion of the current step. @param step  kept by pointer until the next; where its
  /// end is its start, the surface stands still from then on until it is told of another path
  void follow(const StepMotion::Path& step);
  /// Leaves out triangles at samples of a body that lie in the body itself. @param buried  [n * n]
  /// or empty, kept by reference, read at every count
  void leave_out(const std::vector<char>& buried) { buried_ = &buried; }

  /// Number of vertex-face and edge-edge pairs of two surfaces that meet during the step.
  [[nodiscard]] std::int64_t count(const PassingSurface& other) const;
  /// Number of such pairs within this surface, except those that share a vertex.
  [[nodiscard]] std::int64_t count_self() const;
  /// Number of vertices that pass below a height.
  [[nodiscard]] std::int64_t count_below(double height) const;

 private:
  /// Features that are tested with a triangle, so that each is tested once: bits of its vertices,
  /// and of its edges from vertex k to the next.
  struct Owned {
    unsigned char vertices = 0, edges = 0;
  };
  struct Pairs;
  void own_features();
  void fit_nodes();
  [[nodiscard]] Box3d swept_edge(const std::array<int, 2>& ends) const;
  void find(int node, const PassingSurface& other, int other_node, Pairs& pairs) const;
  [[nodiscard]] std::int64_t count_between(int s, const PassingSurface& other, int t,
                                           bool same) const;
  [[nodiscard]] std::int64_t count_vertices(int s, const PassingSurface& other, int t,
                                            bool same) const;

  /// Whether two vertices are one, or are being sewn to each other.
  [[nodiscard]] bool meet(int v, int w) const { return joint_[v] == joint_[w]; }
  [[nodiscard]] bool is_buried(const Triangle& t) const {
    return buried_ != nullptr && !buried_->empty() &&
           std::any_of(t.begin(), t.end(), [&](int v) { return (*buried_)[v] != 0; });
  }
  [[nodiscard]] bool touches(const Triangle& t, int v) const {
    return meet(t[0], v) || meet(t[1], v) || meet(t[2], v);
  }

  std::vector<Triangle> triangles_;  // by representatives of classes of mates
  std::vector<int> joint_;           // [n * n] the class that a sample is sewn into, or itself
  std::vector<Owned> owned_;         // [F]
  BoxTree tree_;
  std::vector<Box3d> boxes_;         // [nodes] swept by the step
  std::vector<Box3d> swept_boxes_;   // [F] the same, of triangles
  std::vector<Box3d> sample_boxes_;  // [n * n] the same, of samples
  StepMotion::Path step_{};
  const std::vector<char>* buried_ = nullptr;
};

/// Counts, in every step of a run, what passes through what, by continuous detection. It shares no
/// code with any collider.
class PassingCheck {
 public:
  struct Surface {
    const GeometryImage* image = nullptr;
    const Planes3* positions = nullptr;
    const BorderMates* sewn = nullptr;  ///< of a garment: the mates with its seams closed
    /// Of a body: see PlacedBody; kept by reference. Null: none is buried.
    const std::vector<char>* buried = nullptr;
  };
  /// @param cloths, bodies  at the start of the run
  PassingCheck(std::span<const Surface> cloths, std::span<const Surface> bodies,
               std::optional<double> ground);
  /// Number of passings of all cloths through themselves, each other, bodies and the ground.
  [[nodiscard]] std::int64_t count(const StepMotion& step);

 private:
  std::vector<PassingSurface> cloths_, bodies_;
  std::optional<double> ground_;
};

}  // namespace weft
