#pragma once

#include "weft/cloth/kernels/kernel_table.h"

// The inner loops of the methods that store springs by direction, implicit and explicit. As those
// of kernel_table.h: compiled once for every instruction set, the same bits in each.

namespace weft {

/// The springs between the particles first .. last - 1 of a row and one of their neighbours. All
/// pointers but those of `position` and `velocity` are shifted so that column c belongs to particle
/// c.
struct NeighbourSprings {
  int first, last;
  const float *rest_length, *stiffness, *damping;
  ConstRow3 position, other_position;  ///< [m]
  ConstRow3 velocity, other_velocity;  ///< [m/s], read by damping alone
};

/// The blocks a 1 + s s^T between particles and a neighbour, shifted likewise; see SpringMatrix.
struct NeighbourBlocks {
  int first, last;
  const float* transverse;       ///< a [kg]
  ConstRow3 axial;               ///< s [sqrt(kg)]
  ConstRow3 value, other_value;  ///< of a product
};

/// Rows of six planes that are written: a symmetric block a sample.
struct BlockRowOut {
  float *xx, *xy, *xz, *yy, *yz, *zz;
};

/// The diagonal blocks to be inverted: block + contact + mass on the diagonal, each times its
/// factor.
struct InvertedRow {
  BlockRow block, contact;
  const float* mass;   ///< [kg]; null: none
  const float* moves;  ///< the inverse is 0 where this is; null: where the sum of the diagonal is
  float block_factor, contact_factor, mass_factor;
};

/// Three rows of a plane with their weights. Above and below are null beyond the border; weights
/// null: 1.
struct WeighedRows {
  const float *above, *here, *below;
  const float *above_weight, *here_weight, *below_weight;
};

/// An iteration of conjugate gradients on a row: v += alpha p, r -= alpha q.
struct GradientStepRow {
  float alpha;
  ConstRow3 direction, image;  ///< p, q
  Row3 residual, value;        ///< r, v
};

/// Positions, velocities and forces of a row at the start of a step.
struct StartRow {
  float time_step;   ///< [s]
  float gravity[3];  ///< [m/s^2]
  ConstRow3 position, velocity;
  ConstRow3 force;     ///< [N]
  const float* mass;   ///< [kg], or its inverse
  const float* count;  ///< 1 on representatives, 0 on their mates
};

struct ImplicitKernels {
  /// force += k (l - r) d / l [N].
  void (*elastic)(const NeighbourSprings& row, Row3 force);
  /// force += c (u . d) d / l^2, u the relative velocity [N].
  void (*axial_damping)(const NeighbourSprings& row, Row3 force);
  /// a and s of the springs between a row and a neighbour.
  void (*linearise)(const NeighbourSprings& row, float time_step, float* transverse, Row3 axial);
  /// out += (a 1 + s s^T) (value - other).
  void (*multiply)(const NeighbourBlocks& row, Row3 out);
  /// out += a 1 + s s^T.
  void (*add_blocks)(const NeighbourBlocks& row, const BlockRowOut& out);

  /// out += mass value.
  void (*add_mass)(int n, const float* mass, ConstRow3 value, Row3 out);
  /// out = the inverses by cofactors, of blocks scaled to a trace of 1, which keeps the
  /// determinants of small masses within single precision.
  void (*invert_blocks)(int n, const InvertedRow& row, const BlockRowOut& out);
  /// value = B value.
  void (*multiply_blocks)(int n, const BlockRow& blocks, Row3 value);

  /// @return the largest |p|^2
  float (*gradient_step)(int n, const GradientStepRow& row);
  /// p = z + beta p.
  void (*update_direction)(int n, float beta, ConstRow3 correction, Row3 direction);
  /// out -= value.
  void (*subtract)(int n, ConstRow3 value, Row3 out);

  /// The transpose of linear interpolation both ways: a coarse row of up to three fine ones of n
  /// samples. @param line  scratch of n values
  void (*restrict_plane)(int n, const WeighedRows& fine, float* line, float* out);

  /// v1 = v + h g.
  void (*fall)(int n, const StartRow& start, Row3 velocity);
  /// M (v + h g) + h f, each sample's own part.
  void (*right_side)(int n, const StartRow& start, Row3 out);
  /// x1 = x + h v1.
  void (*move)(int n, const StartRow& start, ConstRow3 velocity, Row3 position);
  /// v1 = v + h (f / m + g), `mass` being the inverse one; x1 = x + h v1.
  void (*advance)(int n, const StartRow& start, Row3 position, Row3 velocity);
};

/// The kernels of an instruction set; the processor must have it to run them.
const ImplicitKernels& implicit_kernels_for(InstructionSet set);

}  // namespace weft
