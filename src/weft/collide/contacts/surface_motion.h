#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "weft/collide/kernels/motion_kernels.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/thread_team.h"
#include "weft/grid.h"

namespace weft {

/// Motion of a body's surface in a step along its normals, as obstacles before it meet it. Normals
/// are means over the triangles around a point, weighted by area: slivers, as images have some,
/// count little.
class SurfaceMotion {
 public:
  /// @param grid  kept by reference
  explicit SurfaceMotion(const SurfaceGrid& grid);

  /// Measures all points in a step.
  /// @param start, end  [n x n] kept by pointer [m]
  void measure(const Planes3& start, const Planes3& end, ThreadTeam& team);
  /// Accepts the step that was measured last: the next one starts where it ends.
  void arrive() { start_ = 1 - start_; }
  /// The next step starts elsewhere.
  void forget() { knows_start_ = false; }

  /// Normals of all samples, the same of all mates; 0 where there is no area.
  struct Normals {
    Planes3 unit;
    /// Slant of the triangles around a point against its normal: the part of a sliding displacement
    /// by which they may approach. Twice the root mean square of the sine of their tilt.
    Grid<float> slant;
  };
  [[nodiscard]] const Normals& at_start() const { return ends_[start_]; }
  [[nodiscard]] const Normals& at_end() const { return ends_[1 - start_]; }
  /// Approach of a point: the absolute value of its displacement along the mean of its normals at
  /// both ends. A surface that slides along itself, as a ball that turns in place, has none. [m]
  [[nodiscard]] double approach(int row, int col) const;
  /// Rotation of a point's normal in the step: nearly the angle, as long as it is small. [rad]
  [[nodiscard]] double turn(int row, int col) const;

 private:
  /// Areas of two rows of cells, each with a cell of none before and behind it.
  using Scratch = std::vector<float>;
  void measure(const Planes3& at, Normals& out, ThreadTeam& team);
  void find_areas(const MotionKernels& kernels, const Planes3& at, int row, float* out) const;
  void sum_row(const MotionKernels& kernels, int row, const float* before, const float* behind,
               Normals& out) const;
  void sum_mates(Normals& out) const;

  const SurfaceGrid* grid_;
  Grid<float> rising_;  // [cells x (cells + 2)] 1 where a diagonal rises; 0 before and behind rows
  Grid<float> there_;   // [cells x cells] 1 where a cell lies in a chart
  std::vector<float> none_;          // [cells + 2] zeros
  std::vector<int> mates_, starts_;  // classes of mates, one after another
  std::vector<Scratch> scratch_;     // of each worker
  Normals ends_[2];
  int start_ = 0;             // which of them is the start
  bool knows_start_ = false;  // its normals are those of the start
  const Planes3 *from_ = nullptr, *to_ = nullptr;
};

}  // namespace weft
