#pragma once

#include "weft/mesh.h"
#include "weft/vec.h"

namespace weft {

/// The standing figure as a field (weft/mesh/shapes/field.h): 1.75 m tall, feet on y = 0, facing
/// +z, arms away from the body. Symmetric in x.
double mannequin_field(Vec3d point);
/// The figure without the head; the neck continues to where the head would be.
double mannequin_body_field(Vec3d point);

/// The middle line of an arm, from the shoulder joint to the elbow, at x > 0 [m].
struct UpperArm {
  Vec3d shoulder, elbow;
};
UpperArm mannequin_upper_arm();

/// The figure as a closed mesh of genus 0, finer where the shape is: face, hands, feet.
TriangleMesh mannequin_mesh();

}  // namespace weft
