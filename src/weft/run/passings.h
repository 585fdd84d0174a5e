#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "weft/geometry_image.h"
#include "weft/mesh/box_tree.h"
#include "weft/simulation.h"

namespace weft {

/// A triangulated surface whose ways are looked at, each vertex and edge once.
class PassingSurface {
 public:
  /// @param start  where its tree is made for [n x n] [m]
  PassingSurface(const GeometryImage& image, const Planes3& start);
  /// Takes a step. @param step  kept by pointer until the next
  void follow(const StepMotion::Path& step);

  /// Vertices and faces, and pairs of edges, of two surfaces that meet on their ways.
  [[nodiscard]] std::int64_t count(const PassingSurface& other) const;
  /// The same of one surface with itself, but for those that share a vertex.
  [[nodiscard]] std::int64_t count_self() const;
  /// Vertices that go beneath a height.
  [[nodiscard]] std::int64_t count_below(double height) const;

 private:
  /// Which features of a triangle are counted as its own: bits of its vertices and of its edges,
  /// from vertex k to the next.
  struct Owned {
    unsigned char vertices = 0, edges = 0;
  };
  struct Pairs;
  void own_features();
  void find(int node, const PassingSurface& other, int other_node, Pairs& pairs) const;
  [[nodiscard]] std::int64_t count_between(int s, const PassingSurface& other, int t,
                                           bool same) const;
  [[nodiscard]] std::int64_t count_vertices(int s, const PassingSurface& other, int t,
                                            bool same) const;

  std::vector<Triangle> triangles_;  // by samples that stand for their classes
  std::vector<Owned> owned_;         // [F]
  BoxTree tree_;
  std::vector<Box3d> boxes_;        // [nodes] of what they sweep
  std::vector<Box3d> swept_boxes_;  // [F] the same of triangles
  StepMotion::Path step_{};
};

/// Looks at every step of a run for what passes through what, by continuous detection. It shares no
/// code with any collider.
class PassingCheck {
 public:
  /// @param cloths, bodies  as they stand at the start
  struct Surface {
    const GeometryImage* image = nullptr;
    const Planes3* positions = nullptr;
  };
  PassingCheck(std::span<const Surface> cloths, std::span<const Surface> bodies,
               std::optional<double> ground);
  /// Of all cloths with themselves, each other, bodies and the ground.
  [[nodiscard]] std::int64_t count(const StepMotion& step);

 private:
  std::vector<PassingSurface> cloths_, bodies_;
  std::optional<double> ground_;
};

}  // namespace weft
