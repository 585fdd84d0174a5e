#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/measure.h"

namespace weft::testing {

/// Compares with the known value, and records the row for the table of `./dev bench validate`.
inline void check(const std::string& what, double wanted, double measured, double tolerance) {
  EXPECT_NEAR(measured, wanted, tolerance) << what;
  ::testing::Test::RecordProperty(what,
                                  fmt::format("{}|{}|{}|{}", what, wanted, measured, tolerance));
}

/// A flat strip in the xz plane: `length` along x and the columns, from 0 on; `width` along z.
inline Planes3 flat_strip(int n, double length, double width) {
  Planes3 p(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      p.set(r, c, vec_cast<float>(Vec3d{length * c / (n - 1), 0, width * r / (n - 1)}));
  return p;
}

/// Pins a sample where it is in a state.
inline void pin_at(Cloth& cloth, int row, int col, const Planes3& position) {
  pin(cloth, row * cloth.size + col, vec_cast<double>(position.at(row, col)));
}

/// Lets a cloth sink to rest without swinging past it: long steps of implicit Euler, each from
/// stillness, so that its energy falls.
inline void come_to_rest(const Cloth& cloth, double step, int steps, ClothState& state) {
  ThreadTeam team(1);
  const StepInput input{step, {0, -9.81F, 0}};
  const ImplicitOptions options{.max_iterations = 400, .tolerance = 1e-6};
  const auto integrator = make_integrator(options, cloth, input, team);
  for (int i = 0; i < steps; ++i) {
    for (Grid<float>* plane : {&state.velocity.x, &state.velocity.y, &state.velocity.z})
      plane->fill(0);
    run(*integrator, input, 1, state);
  }
}

}  // namespace weft::testing
