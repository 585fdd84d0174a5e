#pragma once

#include <memory>
#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/param/border_relaxation.h"
#include "weft/param/collapse_hierarchy.h"
#include "weft/param/vertex_star.h"

namespace weft {

/// The inner vertices of a coarsened disk in groups, for a sweep by several threads: a vertex comes
/// in a later group than all its neighbours of lower index, so no two of a group are neighbours.
/// What moves the vertices of group after group, by what is around each, has the same bits as what
/// moves them in ascending order.
struct SweepSchedule {
  std::vector<int> vertices;  ///< group after group, ascending inside one
  std::vector<int> first{0};  ///< [groups + 1] where each begins
  int largest_valence = 0;

  [[nodiscard]] int group_count() const { return static_cast<int>(first.size()) - 1; }
};
SweepSchedule schedule_sweep(const CollapseHierarchy& mesh);

/// Relaxes single vertices of a coarsened disk to lower the stretch energy of the triangles around
/// them, by Newton steps in their own one or two coordinates, with the exact Hessian where that is
/// positive definite. A step ends before the first triangle degenerates, and its result is checked
/// by exact arithmetic, so a valid map stays valid.
class VertexMover {
 public:
  /// Keeps references to all of them.
  /// @param triangles  [F] as they are now
  /// @param uv         [D] a valid map
  /// @param threads    that sweep; they do not show in the result
  VertexMover(const CollapseHierarchy& mesh, std::span<const StarTriangle> triangles,
              std::span<Vec2d> uv, int threads = 1);

  /// Moves an inner vertex. @return the share of the energy around it that this takes away
  double improve(int vertex) { return improve(vertex, stars_[0]); }
  /// Moves an inner vertex to the centre of the kernel of its neighbours where that lowers the
  /// energy: leaves at once a narrow corner from which Newton steps are very short.
  bool centre(int vertex);
  /// Moves a border vertex along its side, and its mate with it.
  bool improve(const BorderFreedom& freedom);
  /// Moves all inner vertices and all freedoms so many times, in order.
  void sweep(int times, std::span<const BorderFreedom> freedoms = {});
  /// Moves all inner vertices once, then again those that moved far in the last sweep and their
  /// neighbours: most of a fine mesh comes to rest at once. All freedoms move in every sweep.
  /// @param max  number of sweeps
  void sweep_restless(int max, std::span<const BorderFreedom> freedoms = {});

 private:
  double improve(int vertex, VertexStar& star);
  void plan_sweeps();
  template <class Visit>
  void for_each_inner(bool alone, const Visit& visit);
  [[nodiscard]] int wake();

  const CollapseHierarchy& mesh_;
  std::span<const StarTriangle> triangles_;
  std::span<Vec2d> uv_;
  std::unique_ptr<ThreadTeam> team_;  ///< none: one thread
  std::vector<VertexStar> stars_;     ///< one a thread
  VertexStar mate_star_;
  SweepSchedule schedule_;       ///< of the mesh as it is, where that suits several threads
  std::vector<char> awake_;      ///< [V] whether a vertex takes part in the next restless sweep
  std::vector<char> moved_far_;  ///< [V] in the last one
};

}  // namespace weft
