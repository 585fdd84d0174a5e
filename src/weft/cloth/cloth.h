#pragma once

#include <array>
#include <optional>
#include <vector>

#include "weft/cloth_state.h"
#include "weft/geometry_image.h"
#include "weft/grid.h"
#include "weft/material.h"

namespace weft {

/// The springs of one direction (row + down, col + right) as planes: element (r, c) belongs to the
/// spring from sample (r, c) to (r + down, c + right); where there is none its stiffness is 0 and
/// its rest length 1.
struct SpringPlane {
  int down = 0, right = 0;
  Grid<float> rest_length;  ///< [n x n] [m], > 0
  Grid<float> stiffness;    ///< [n x n] [N/m], >= 0
  Grid<float> damping;      ///< [n x n] along the spring [N s/m], >= 0
};

/// The six directions in their fixed order: two of stretch, two of shear, two of bending.
enum SpringDirection { stretch_u, stretch_v, shear_1, shear_2, bend_u, bend_v, spring_directions };

/// Numbers of neighbours in the bending stencil, in the order of its weight planes.
inline constexpr int bending_neighbours = 8, straight_bending_neighbours = 4;

/// Edges of Dirichlet energy k |x_j - x_i|^2 / 2 between samples near a free border, k of either
/// sign, sorted by row. Each edge is stored at both of its ends.
struct BorderBending {
  struct Edge {
    int col = 0;                       ///< of the end in this row
    int other_row = 0, other_col = 0;  ///< the other end
    float stiffness = 0;               ///< k [N/m]
  };
  std::vector<Edge> edges;
  std::vector<int> starts;  ///< [n + 1] first edge of each row; empty without edges
};

/// Resistance to bending, sum area |L x - R|^2 / 2 with
///   L = sqrt(B_warp) d^2/du^2 + sqrt(B_weft) d^2/dv^2
/// of the rest surface, as |u|^2 / 2 with u = M x - sqrt(area) R and M = sqrt(area) L. Element (r,
/// c) of a weight plane belongs to a neighbour of sample (r, c):
/// (M x)_i = sum_j weight_j (x_j - x_i), summed over all samples of a class of mates. L vanishes on
/// affine maps of the rest surface. Along free borders it is the second derivative along the border
/// alone, at free corners zero.
struct BendingPlanes {
  std::array<Grid<float>, bending_neighbours> weight;  ///< [n x n] each [sqrt(N/m)]
  Grid<float> rest;        ///< [n x n] sqrt(area) |R|, the same on all of a class [sqrt(N m)]
  BorderBending border;    ///< added to the energy, so that free borders resist saddles
  Grid<float> diagonal;    ///< [n x n] of M^T M plus the border term: of the class on its
                           ///< representative, else 0 [N/m]
  bool active = false;     ///< whether any weight is not 0
  bool diagonals = false;  ///< whether any weight beyond the four straight neighbours is not 0
  bool curved = false;     ///< whether any rest curvature is not 0
};

/// A pinned surface point: all samples of one class.
struct Pin {
  int sample = 0;             ///< that is held, of its class
  Vec3d target;               ///< where it is held [m]
  std::vector<int> copies{};  ///< all samples of the class, ascending
};

/// A stretch or shear spring with an end on the border of the image, between the representatives of
/// its ends. The copies of a spring on both sides of a seam are stored once.
struct BorderSpring {
  int from = 0, to = 0;   ///< samples, from < to
  float rest_length = 1;  ///< [m]
  bool stretch = false;   ///< else shear
};

/// A cloth without its state: rest shape, masses, springs, bending and pins. Mates are one particle
/// stored at several samples. Samples of no chart (holes) follow the particle whose mates they are,
/// and have no springs.
struct Cloth {
  int size = 0;
  Material material;
  BorderMates mates;
  /// While seams are being sewn: the mates of which all samples are at one place. Those of `mates`
  /// then keep their distances from each other in a step's solve.
  std::optional<BorderMates> apart;
  Planes3 rest;  ///< [n x n] rest positions [m]
  /// Positions at the start, where the rest shape lies elsewhere: flat panels. [n x n] [m]
  std::optional<Planes3> start;
  Grid<float> mass;          ///< [n x n] of the particle: summed over its class [kg], > 0
  Grid<float> inverse_mass;  ///< [n x n] 0 where pinned, and where no chart is
  Grid<float> owner;         ///< [n x n] 1 on representatives, 0 on their mates
  std::array<SpringPlane, spring_directions> springs;
  BendingPlanes bending;
  std::vector<BorderSpring>
      border_springs;  ///< ordered by direction, then by the sample they start from
  std::vector<Pin> pins;
  int particles = 0;        ///< mates counted once
  double rest_spacing = 0;  ///< mean rest length of the stretch springs [m]

  /// The mates of which all samples are at one place.
  [[nodiscard]] const BorderMates& together() const { return apart ? *apart : mates; }
  /// Whether a copy of a pin is where the pin is held: others are still to be sewn to it.
  [[nodiscard]] bool is_held_at(const Pin& pin, int copy) const {
    return !apart || apart->representative(copy) == apart->representative(pin.sample);
  }
  [[nodiscard]] const Planes3& start_positions() const { return start ? *start : rest; }
};

/// Lower bounds of rest lengths, relative to the mean stretch spring, and of masses, relative to
/// the mean particle. Maps of real meshes have degenerate cells, whose lengths and masses would
/// otherwise be divisors close to zero.
inline constexpr double min_relative_length = 1e-3, min_relative_mass = 1e-4;

/// The rest shape of a cloth.
struct ClothShape {
  const Planes3& rest;       ///< [n x n] positions [m]
  const BorderMates& mates;  ///< samples that are one particle
  /// Those through which the fabric resists bending: at other mates the rest shape is not one
  /// surface, as panels that are laid flat are not. Null: all.
  const BorderMates* bending = nullptr;
  /// Directions of the warp at rest, of any length but 0, where it is that of the rows. [n x n];
  /// null: that of the rows.
  const Planes3* warp = nullptr;
};

/// Builds the cloth of a rest shape. A stretch or shear spring of rest
/// length l stands for a strip of rest width w = (its share of the area beside it) / l: half of
/// each cell that a stretch spring borders on, the whole cell of a shear spring; its stiffness is Y
/// w / l, with Y = Y_warp cos^2 + Y_weft sin^2 of a stretch spring's angle to the warp.
/// @throws SceneError for a material value out of range, or samples that carry no mass
Cloth make_cloth(const ClothShape& shape, const Material& material);
/// The same of positions whose mates are equal. @param rest  [n x n] [m]
Cloth make_cloth(const Planes3& rest, const BorderMates& mates, const Material& material);

/// Pins the class of a sample at a target. Pinning it again changes the target.
/// @return index of its pin in the cloth's pins
/// @throws SceneError for a sample outside the image
int pin(Cloth& cloth, int sample, Vec3d target);
/// Removes the last pin and frees its samples. @pre there is one
void unpin_last(Cloth& cloth);

/// The state at the start, which is the rest shape if nothing else is set, with the same velocity
/// at every sample.
ClothState rest_state(const Cloth& cloth, Vec3f velocity = {});

}  // namespace weft
