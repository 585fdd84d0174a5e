#pragma once

#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/mesh/winding.h"
#include "weft/simulation.h"

namespace weft {

/// The triangles of an image with corners replaced by the representatives of their classes of
/// mates; those with a repeated corner are left out.
std::vector<Triangle> joined_triangles(const GeometryImage& image);

/// Inside test for a placed surface, by winding numbers.
class ClosedBody {
 public:
  /// @param image      gives the triangles
  /// @param positions  kept by reference [n x n] [m]
  ClosedBody(const GeometryImage& image, const Planes3& positions);
  /// Whether the surface is closed, as follow and mark_inside require.
  [[nodiscard]] bool closed() const { return winding_.has_value(); }
  /// Updates the test to the current positions.
  void follow();
  /// Whether it winds around a point. [m] @pre closed
  /// @param towards  see WindingNumbers::at
  [[nodiscard]] bool holds(Vec3d point, Vec3d towards = {1, 1, 1}) const {
    return depth(point, towards) > 0;
  }
  /// How often it winds around a point, in either direction: 2 where it lies in itself. [m]
  /// @pre closed
  [[nodiscard]] int depth(Vec3d point, Vec3d towards = {1, 1, 1}) const;
  /// Whether it winds around all samples of another surface, as a room does. [m] @pre closed
  [[nodiscard]] bool holds_all(const Planes3& samples) const;
  /// Marks the samples of another surface, mates too, around which the body winds: 1, or 2 where it
  /// does so twice or more. [n * n]
  void mark_inside(const Planes3& samples, ThreadTeam& team, std::vector<char>& inside) const;

 private:
  void put_corners(std::span<Corners> corners) const;

  const Planes3* positions_;
  std::vector<Triangle> triangles_;  // by representatives of classes of mates
  Box3d box_;
  std::optional<WindingNumbers> winding_;
};

/// Which bodies a cloth is inside of at the start of a run.
struct StartSides {
  std::vector<StartInside> inside;
  std::vector<char> kept_in;    ///< of each body: whether it keeps the cloth in
  std::vector<int> wrong_side;  ///< of each sample: the number, from 1, of a body that pushes it
                                ///< out; 0: none [n * n]
};

/// Finds the closed bodies that a cloth begins inside of, wholly or in part.
/// @param containers  whether the collider supports containers; if not, every body pushes out
StartSides find_start_sides(const SimulatedCloth& cloth, std::span<const PlacedBody> bodies,
                            bool containers, ThreadTeam& team);

/// Describes such a start in one line.
std::string start_inside_text(const StartInside& found);

}  // namespace weft
