#include <gtest/gtest.h>

#include "tests/cloth/baselines/filter_residual.h"
#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/contact_springs.h"
#include "weft/cloth/baselines/multigrid/multigrid_preconditioner.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/cloth/mates.h"

namespace weft {
namespace {

using namespace testing;

/// A cloth of which the upper left part lies deep within a slanted half-space.
struct Pressed {
  explicit Pressed(const Cloth& of, Vec3f slant = {0.6F, 0.8F, 0})
      : cloth(of), normal(slant), filter(of, {1.0 / 60}, team), springs(of) {
    for (int r = 0; r < of.size / 2; ++r)
      for (int c = 0; c < of.size / 2; ++c)
        contacts.push_back(
            {{r * of.size + c}, {1}, normal, dot(normal, of.rest.at(r, c)) + 0.01F, 0, {}});
    springs.set_contacts(contacts, of.rest, 1.0 / 60);
    team.run([&](Worker& worker) {
      springs.update_active(of.rest, filter.finest().inverse_diagonal, worker);
      filter.renew_contacts(springs.loads(), worker);
    });
  }
  Planes3 cycle(const Planes3& right) {
    filter.rhs() = right;
    team.run([&](Worker& worker) { filter.cycle(worker); });
    return filter.value();
  }
  /// b - (A + C) x, whole particles.
  Planes3 residual(const Planes3& b, const Planes3& x) const {
    const int n = cloth.size;
    Planes3 out = filter_residual(filter.finest(), Planes3(n), x);
    for (int r = 0; r < n; ++r)
      if (filter.finest().contacts.row(r))
        kernels_for(InstructionSet::baseline)
            .subtract_blocks(n, filter.finest().contacts.own_row(r), row_of(x, r), row_of(out, r));
    sum_over_mates(cloth.mates, {&out.x, &out.y, &out.z});
    for (int s = 0; s < n * n; ++s) out.set(s, out.at(s) + b.at(s));
    return out;
  }

  const Cloth& cloth;
  Vec3f normal;
  ThreadTeam team{2};
  MultigridPreconditioner filter;
  ContactSprings springs;
  std::vector<Contact> contacts;
};

double size_of(const Planes3& x) {
  double sum = 0;
  for (int s = 0; s < x.size() * x.size(); ++s) sum += squared_length(vec_cast<double>(x.at(s)));
  return std::sqrt(sum);
}

TEST(ContactBlocks, CyclesConvergeUnderContactsAtAnySize) {
  for (const int n : {17, 33, 65, 129})
    for (const Cloth& cloth : {sheet_cloth(n), make_cloth(flat_sheet(n), torus_mates(n), {})}) {
      Pressed pressed(cloth);
      Planes3 b(n), x(n);
      shake(cloth, 1, b);
      for (int i = 0; i < 30; ++i) {
        const Planes3 w = pressed.cycle(pressed.residual(b, x));
        for (int s = 0; s < n * n; ++s) x.set(s, x.at(s) + w.at(s));
      }
      EXPECT_LT(size_of(pressed.residual(b, x)), 1e-3 * size_of(b)) << n;
    }
}

TEST(ContactBlocks, HoldAlongNormalsAndLeaveSlidingFree) {
  const int n = 33;
  const Cloth cloth = sheet_cloth(n);
  Pressed pressed(cloth);
  const Vec3f along{0.8F, -0.6F, 0};
  const auto moved = [&](Vec3f push) {
    Planes3 b(n);
    const Grid<float>& weight = pressed.filter.mass_weight();
    for (int s = 0; s < n * n; ++s) b.set(s, weight(s / n, s % n) * push);
    Planes3 x(n);
    for (int i = 0; i < 30; ++i) {
      const Planes3 w = pressed.cycle(pressed.residual(b, x));
      for (int s = 0; s < n * n; ++s) x.set(s, x.at(s) + w.at(s));
    }
    return x.at(n / 4, n / 4);
  };
  EXPECT_LT(length(moved(pressed.normal)), 1e-3);
  EXPECT_LT(length(moved(along) - along), 1e-2);
}

TEST(ContactBlocks, AreGoneWhenContactsAre) {
  const int n = 33;
  const Cloth cloth = sheet_cloth(n);
  Pressed pressed(cloth);
  ThreadTeam team(1);
  MultigridPreconditioner fresh(cloth, {1.0 / 60}, team);
  Planes3 b(n);
  shake(cloth, 1, b);
  pressed.springs.clear();
  pressed.team.run(
      [&](Worker& worker) { pressed.filter.renew_contacts(pressed.springs.loads(), worker); });
  const Planes3 again = pressed.cycle(b);
  fresh.rhs() = b;
  team.run([&](Worker& worker) { fresh.cycle(worker); });
  for (int s = 0; s < n * n; ++s) ASSERT_EQ(again.at(s), fresh.value().at(s));
}

}  // namespace
}  // namespace weft
