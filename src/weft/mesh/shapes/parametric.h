#pragma once

#include "weft/mesh.h"

namespace weft {

// The shapes that are images by nature, as maps of the unit square to the world [m]. The meshes and
// the images of these shapes sample the same functions.

/// A flat square of side 1 m in the xz plane centred on the origin, u along +x, v along +z; so
/// dP/du x dP/dv points down.
Vec3d sheet_point(double u, double v);

/// A flat disk of radius 0.5 m in the xz plane. The square maps to it by concentric rings with
/// equal areas (Shirley and Chiu 1997): unlike smooth maps, whose Jacobian must vanish at the
/// corners, it keeps every cell fat; the price is a kink along the diagonals.
Vec3d disk_point(double u, double v);

inline constexpr double torus_major_radius = 0.35, torus_minor_radius = 0.15;
/// A torus around the y axis: u runs round the ring, counter-clockwise seen from above, v round the
/// tube; dP/du x dP/dv points outwards.
Vec3d torus_point(double u, double v);

inline constexpr double cylinder_radius = 0.2, cylinder_height = 1;
/// An open tube around the y axis: u runs round it, counter-clockwise seen from above, v up;
/// dP/du x dP/dv points outwards.
Vec3d cylinder_point(double u, double v);

TriangleMesh sheet_mesh();
TriangleMesh disk_mesh();
TriangleMesh torus_mesh();
TriangleMesh cylinder_mesh();

/// A trefoil knot tied of a round tube, lying on the xz plane around the y axis: closed, genus 1.
TriangleMesh knot_mesh();
inline constexpr double knot_tube_radius = 0.06;  ///< [m]
/// The middle line of the tube, closed: t in [0, 1], t = 1 is the start again.
Vec3d knot_point(double t);

}  // namespace weft
