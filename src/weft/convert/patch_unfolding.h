#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/convert/sliding_samples.h"
#include "weft/core/quasi_newton.h"
#include "weft/mesh.h"

namespace weft {

/// Unfolds a patch of a grid: finds displacements of its points in their tangent planes under which
/// its triangles turn the right way round and have good shapes. Minimises the energy of
/// [garanzha21], which grows without bound as a triangle's area vanishes; a regularisation, softer
/// the more a triangle is the wrong way round, keeps it finite there.
class PatchUnfolding {
 public:
  /// A point, with its unit normal to the surface.
  struct Point {
    Vec3d position;  ///< [m]
    Vec3d normal;
    bool moves = false;
  };
  /// @param triangles  corners are numbers of points; the first is to have the right angle
  /// @param feet       of the triangles: in these planes their middles are to lie
  PatchUnfolding(std::span<const Point> points, std::span<const Triangle> triangles,
                 std::span<const PlaneAt> feet);

  struct Attempt {
    /// Whether every point begins amid its neighbours. Triangles may all turn the right way round,
    /// and yet twice round a point: their energy does not lead out of that.
    bool from_smooth = false;
    /// Of a minimisation. One that ends early lets the next one's harder barrier freeze what is
    /// folded, but goes less far, which is better where the surface bends.
    int max_steps = 60;
  };
  /// @return the displacement of each point, in its tangent plane, 0 for those that do not move [m]
  [[nodiscard]] std::vector<Vec3d> find(const Attempt& attempt) const;

 private:
  struct Axes {
    Vec3d first, second;
  };
  /// A triangle's edges from its first corner, in units of spacing_.
  struct Jacobian {
    Vec2d to_second, to_third;
    [[nodiscard]] double area() const { return cross(to_second, to_third); }
  };
  /// A triangle in the plane in which it is judged: how it lies, and how it moves with its corners.
  struct Flat {
    /// What a corner's displacement along each of its axes does; nothing where it does not move.
    struct Corner {
      Vec2d first, second;  // in the triangle's plane
      Vec2d off;            // to the distance of its middle from the surface
      [[nodiscard]] Vec2d moved(Vec2d by) const { return by.x * first + by.y * second; }
      [[nodiscard]] Vec2d pulled(Vec2d slope) const {
        return {dot(slope, first), dot(slope, second)};
      }
    };
    Triangle corners{};
    std::array<Corner, 3> moves;
    Jacobian rest;
    double off = 0;  // distance of its middle from the plane at its foot, in units of spacing_
  };
  /// An energy, and its derivatives by a triangle's second and third corner.
  struct Slopes {
    double value = 0;
    Vec2d second, third;
  };
  static Axes axes_of(Vec3d normal);
  [[nodiscard]] Flat flat(const Triangle& corners, const PlaneAt& foot) const;
  static Slopes energy_of(const Jacobian& j, double softness);
  [[nodiscard]] Vec3d displacement(const Vectors& at, int point) const;
  [[nodiscard]] Vec3d place(const Vectors& at, int point) const;
  static Jacobian jacobian(const Flat& triangle, const Vectors& at);
  [[nodiscard]] double min_area(const Vectors& at) const;
  /// Puts points amid those that they share triangles with, by sweeps.
  void smooth(Vectors& at) const;
  /// @param at  displacements in the tangent planes, in units of spacing_
  double energy(const Vectors& at, double softness, Vectors& gradient) const;
  static double distance(const Flat& triangle, const Vectors& at);

  std::vector<Point> points_;
  std::vector<Axes> axes_;  // of the points
  std::vector<Flat> triangles_;
  double spacing_ = 1;  // of the grid, by the triangles' mean area [m]
};

}  // namespace weft
