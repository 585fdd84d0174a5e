#pragma once

#include "weft/cloth/cloth.h"

namespace weft {

/// The rest geometry from which springs and masses are computed.
struct RestShape {
  const Planes3& position;
  const BorderMates& mates;
  const Planes3* warp = nullptr;  ///< see ClothShape
  Grid<double> cell_area;         ///< [(n-1) x (n-1)] of both triangles of each quad [m^2]
  double mean_spacing = 0;        ///< mean rest length of the stretch springs [m]

  RestShape(const Planes3& rest, const BorderMates& border, const Planes3* warp_at_rest = nullptr);
  [[nodiscard]] int size() const { return position.size(); }
  /// The direction of the warp at a sample, of unit length; 0: that of the rows.
  [[nodiscard]] Vec3d warp_at(int sample) const {
    return warp != nullptr ? normalized(vec_cast<double>(warp->at(sample))) : Vec3d{};
  }
};

/// The springs of one direction.
SpringPlane make_springs(const RestShape& shape, const Material& material,
                         SpringDirection direction);

/// A quarter of each adjacent cell for every sample, summed over mates, times the density [kg].
Grid<float> make_masses(const RestShape& shape, double density);

}  // namespace weft
