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

/// How a row is solved: as users do who set nothing, or tightly beside that.
struct Way {
  IntegratorOptions options;
  std::string name;  ///< "" for the defaults

  [[nodiscard]] std::string suffix() const { return name.empty() ? "" : ", " + name; }
};

inline const Way defaults{};
inline const Way tight{NewtonOptions{.max_iterations = 200, .tolerance = 1e-4}, "newton to 1e-4"};

/// A quiet cloth, in m g L of a sheet of 1 m.
constexpr double still_energy = 1e-9;

/// Lets a cloth come to rest in steps as users have them, slowed by air. @return its kinetic energy
/// after a quarter of a second more without air, over m g times 1 m
inline double come_to_rest(const Cloth& cloth, const Way& way, double seconds, ClothState& state) {
  constexpr double drag = 8;  // [1/s]
  ThreadTeam team(1);
  const StepInput input{};
  const auto integrator = make_integrator(way.options, cloth, input, team);
  const int slowed = static_cast<int>(seconds / input.time_step);
  const auto kept = static_cast<float>(1 - drag * input.time_step);
  for (int i = 0; i < slowed + 60; ++i) {
    run(*integrator, input, 1, state);
    if (i >= slowed) continue;
    for (Grid<float>* plane : {&state.velocity.x, &state.velocity.y, &state.velocity.z})
      for (int r = 0; r < cloth.size; ++r)
        for (int c = 0; c < cloth.size; ++c) (*plane)(r, c) *= kept;
  }
  return kinetic_energy(cloth, state) / (9.81 * total_mass(cloth));
}

}  // namespace weft::testing
