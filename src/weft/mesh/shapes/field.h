#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "weft/mesh.h"
#include "weft/vec.h"

namespace weft {

/// A shape as a function of space [m]: negative inside, positive outside, and near the surface
/// about the distance from it.
using Field = std::function<double(Vec3d)>;

/// The union of all balls whose centre runs from a to b and whose radius changes linearly [m].
struct RoundCone {
  /// @pre |radius_at_a - radius_at_b| < |b_end - a_end|
  RoundCone(Vec3d a_end, Vec3d b_end, double radius_at_a, double radius_at_b);
  Vec3d a, b;
  double radius_a, radius_b;
  // What every distance needs: b - a, its length, and the sine and cosine of the side's angle to
  // it.
  Vec3d axis;
  double axis_length, slope, cosine;
};
/// Exact signed distance.
double distance_to(const RoundCone& cone, Vec3d point);

/// An ellipsoid with axes along the coordinates [m].
struct Ellipsoid {
  Vec3d centre, radii;
};
/// Signed distance to first order: exact on the surface with unit gradient there.
double distance_to(const Ellipsoid& ellipsoid, Vec3d point);

/// Smooth minimum of two fields: exact where they differ by more than `blend`, else smaller by at
/// most blend / 4; the union of two shapes with a fillet. Once continuously differentiable.
double smooth_min(double a, double b, double blend);
/// Smooth maximum of two fields: the intersection of two shapes with a rounded edge.
double smooth_max(double a, double b, double blend);

/// A limb: the union of round cones along a Catmull-Rom curve through joints. The radii change
/// smoothly too, so that no rings show at the joints.
struct Limb {
  struct Joint {
    Vec3d centre;
    double radius;
  };
  static constexpr int parts = 4;  ///< cones between two joints
  static constexpr int max_joints = 12;
  static constexpr int max_cones = (max_joints - 1) * parts;
  /// @pre 2 .. max_joints joints
  explicit Limb(std::span<const Joint> joints);
  std::vector<RoundCone> cones;
  /// Balls around the cones, by which those that are too far away are told cheaply [m].
  struct {
    std::array<double, max_cones> x{}, y{}, z{}, radius{};
  } balls;
  Box3d box;  ///< holds all of it
};
/// Exact signed distance to the nearest of its cones, or `enough` where that is less.
double distance_to(const Limb& limb, Vec3d point, double enough = HUGE_VAL);

/// Distance to a box, 0 inside.
double distance_to(const Box3d& box, Vec3d point);

/// Gradient of a field by central differences.
Vec3d gradient(const Field& field, Vec3d point);

/// Moves a nearby point onto the surface field = 0 along the gradient.
Vec3d project_to_surface(const Field& field, Vec3d point);
/// Moves a nearby point onto the curve where both fields vanish.
Vec3d project_to_curve(const Field& first, const Field& second, Vec3d point);

/// The surface field = 0 by marching tetrahedra: every cube of a grid is cut into six tetrahedra
/// around its main diagonal, so that cubes fit together and the result is always a closed, oriented
/// 2-manifold (Doi and Koide 1991). Triangles are uneven: see remesh.h.
/// @param box   holds the surface with a margin of a cell
/// @param cell  side of the grid's cubes [m]
TriangleMesh polygonise(const Field& field, const Box3d& box, double cell);

}  // namespace weft
