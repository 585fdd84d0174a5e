#include "weft/cloth/newton/seam_mismatch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/cloth/newton_system.h"

namespace weft {
namespace {

using testing::System;

constexpr double spacing = 0.01;

/// Two square charts one above the other: the last column of the first is sewn to the first column
/// of the second, which begins so many samples farther down.
BorderMates two_squares(int side, int shift) {
  const int n = 2 * side + 2, around = 4 * (side - 1);
  const std::vector<Chart> charts{Chart{"flat", 0, 0, side, side},
                                  Chart{"upright", side + 2, 0, side, side}};
  // Down the first's last column, and up the second's first column towards the start of its border.
  return {n, charts, {{side - 1 + shift, 2 * around, side - 1 - shift}}};
}

/// The second square stands upright on the first.
Planes3 folded(int side, int shift) {
  const BorderMates mates = two_squares(side, shift);
  Planes3 rest(mates.size());
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c) {
      rest.set(r * mates.size() + c, vec_cast<float>(Vec3d{c * spacing, 0, r * spacing}));
      rest.set((side + 2 + r) * mates.size() + c,
               vec_cast<float>(Vec3d{(side - 1) * spacing, c * spacing, (r + shift) * spacing}));
    }
  return rest;
}

/// A load along one axis that goes up and down so many times along the seam.
PaddedVectors wavy_load(System& system, int waves, int axis) {
  const int n = system.cloth.size;
  PaddedVectors load(n, n);
  PaddedPlane* const planes[] = {&load.x, &load.y, &load.z};
  for (int s = 0; s < n * n; ++s)
    if (!system.cloth.mates.is_hole(s))
      (*planes[axis])(s / n, s % n) = static_cast<float>(
          std::cos(std::numbers::pi * waves * double{system.cloth.rest.z(s / n, s % n)} /
                   (n / 2 * spacing)));
  system.team.run([&](Worker& worker) { system.multigrid.complete(load, worker); });
  return load;
}

/// d . A d / d . r of the direction d that a cycle gives for a load r, the largest of many. By as
/// much as it is above 1, the step along d has to be shortened.
double largest_excess(System& system) {
  PaddedVectors product(system.cloth.size, system.cloth.size);
  double largest = 0;
  for (int waves = 1; waves <= 16; ++waves)
    for (const int axis : {0, 1, 2}) {
      const PaddedVectors load = wavy_load(system, waves, axis);
      const PaddedVectors& direction = system.cycle(load);
      system.times(direction, product);
      largest = std::max(largest, system.dot(direction, product) / system.dot(direction, load));
    }
  return largest;
}

// Without the energy of mismatches it is up to 500, and iterations do not converge.
TEST(SeamMismatch, ACorrectionAcrossOneChartDoesNotTearAnother) {
  for (const int side : {30, 33})
    for (const int shift : {0, 1, 2, 3, 5}) {
      const Cloth cloth =
          make_cloth(folded(side, shift), two_squares(side, shift), testing::cotton);
      System system(cloth, 0);
      EXPECT_LE(largest_excess(system), 1.1) << side << ' ' << shift;
      EXPECT_LE(system.iterations_to_a_hundredth(), 8) << side << ' ' << shift;
    }
}

}  // namespace
}  // namespace weft
