#include "weft/cloth/baselines/contact_springs.h"

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/baselines/multigrid/multigrid_preconditioner.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"
#include "weft/core/contact_point.h"

namespace weft {
namespace {

using namespace testing;

const Vec3f up{0, 1, 0};

/// In a step as long as this, what lies however deep may come out.
constexpr double ages = 1e6;

/// Springs of some contacts, heeded where the cloth lies at rest.
struct Springs {
  Springs(const Cloth& of, std::vector<Contact> some)
      : cloth(of), contacts(std::move(some)), filter(of, {1.0 / 240}, team), springs(of) {
    springs.set_contacts(contacts, of.rest, ages);
    update_active(of.rest);
  }
  bool update_active(const Planes3& now) {
    bool grown = false;
    team.run([&](Worker& worker) {
      const bool mine = springs.update_active(now, filter.finest().inverse_diagonal, worker);
      if (worker.rank() == 0) grown = mine;
    });
    return grown;
  }
  /// Whole particles'.
  Planes3 forces(const Planes3& position) {
    const Planes3 none(cloth.size);
    team.run([&](Worker& worker) { springs.update_forces({position, none, none}, worker); });
    Planes3 force(cloth.size);
    for (int r = 0; r < cloth.size; ++r)
      if (springs.loads().row(r)) springs.loads().add_row(r, row_of(force, r));
    sum_over_mates(cloth.mates, {&force.x, &force.y, &force.z});
    return force;
  }
  double energy(const Planes3& position) const {
    double sum = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const double depth = std::max(0.0, depth_of(contacts[i], position));
      sum += springs.loads().stiffness()[i] * depth * depth / 2;
    }
    return sum;
  }

  const Cloth& cloth;
  ThreadTeam team{2};
  std::vector<Contact> contacts;
  MultigridPreconditioner filter;
  ContactSprings springs;
};

/// A point of a triangle against a particle elsewhere, two edges, and a floor: all violated at
/// rest.
std::vector<Contact> mixed_contacts(int n) {
  const Vec3f slanted = normalized(Vec3f{1, 3, -2});
  return {{{n + 2, 5 * n + 1, 5 * n + 2, 6 * n + 1}, {1, -0.5F, -0.2F, -0.3F}, up, 0.002F, 0, {}},
          {{n + 2, n + 3, 7 * n, 7 * n + 1}, {0.3F, 0.7F, -0.9F, -0.1F}, slanted, 2, 0, {}},
          {{n + 2}, {1}, up, 0.001F, 0, {}},
          {{n + 2}, {1}, slanted, 2, 0, {}}};
}

Vec3d sum_of(const Planes3& planes, const Cloth& cloth) {
  Vec3d sum;
  for (int s = 0; s < cloth.size * cloth.size; ++s)
    if (cloth.owner(s / cloth.size, s % cloth.size) > 0) sum += vec_cast<double>(planes.at(s));
  return sum;
}

TEST(ContactSprings, ForcesAreMinusTheGradientOfTheEnergy) {
  const int n = 9;
  for (const Cloth& cloth : {sheet_cloth(n), make_cloth(flat_sheet(n), torus_mates(n), {})}) {
    Springs springs(cloth, mixed_contacts(n));
    Planes3 place = cloth.rest;
    shake(cloth, 1e-3, place);
    const Planes3 force = springs.forces(place);
    constexpr float by = 1.0F / 1024;
    for (const int s : {n + 2, n + 3, 5 * n + 1, 5 * n + 2, 6 * n + 1, 7 * n, 7 * n + 1})
      for (const Vec3f& axis : {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}}) {
        Planes3 ahead = place, behind = place;
        // A sample moves with its mates.
        for (int other = 0; other < n * n; ++other) {
          if (cloth.mates.representative(other) != cloth.mates.representative(s)) continue;
          ahead.set(other, place.at(s) + by * axis);
          behind.set(other, place.at(s) - by * axis);
        }
        const double slope = (springs.energy(ahead) - springs.energy(behind)) / (2 * double{by});
        const double found = dot(force.at(s), axis);
        EXPECT_NEAR(found, -slope, 1e-3 * std::abs(slope) + 1e-3) << s;
      }
  }
}

TEST(ContactSprings, ForcesBetweenPartsOfAClothSumToZero) {
  const Cloth cloth = sheet_cloth(9);
  std::vector<Contact> pairs = mixed_contacts(9);
  pairs.resize(2);
  Springs springs(cloth, pairs);
  const Planes3 force = springs.forces(cloth.rest);
  EXPECT_GT(length(force.at(11)), 1);
  EXPECT_LT(length(sum_of(force, cloth)), 1e-6 * length(force.at(11)));
}

TEST(ContactSprings, EveryContactOfAParticlePushes) {
  const Cloth cloth = sheet_cloth(9);
  const Vec3f aside{1, 0, 0};
  const float edge = cloth.rest.at(20).x + 0.01F;
  Springs springs(cloth, {{{20}, {1}, up, 0.02F, 0, {}}, {{20}, {1}, aside, edge, 0, {}}});
  const Vec3f force = springs.forces(cloth.rest).at(20);
  EXPECT_GT(force.x, 1);
  EXPECT_NEAR(force.y, 2 * force.x, 1e-4 * force.y);
}

TEST(ContactSprings, WeightsShareOutTheForce) {
  const Cloth cloth = sheet_cloth(9);
  Springs springs(cloth, {{{20, 21, 30, 0}, {0.5F, 0.3F, 0.2F, 0}, up, 0.02F, 0, {}}});
  const Planes3 force = springs.forces(cloth.rest);
  const float whole = force.y(2, 2) + force.y(2, 3) + force.y(3, 3);
  EXPECT_GT(whole, 1);
  EXPECT_FLOAT_EQ(force.y(2, 2), 0.5F * whole);
  EXPECT_FLOAT_EQ(force.y(2, 3), 0.3F * whole);
  EXPECT_FLOAT_EQ(force.y(3, 3), 0.2F * whole);
  EXPECT_EQ(force.y(0, 0), 0);
}

TEST(ContactSprings, PushBackOnlyWhatIsBeyondTheSurface) {
  const int n = 9;
  const Cloth cloth = sheet_cloth(n);
  Springs springs(cloth, {{{20}, {1}, up, 0.01F, 0, {}}});
  EXPECT_NEAR(springs.forces(cloth.rest).y(2, 2), 0.01 * springs.springs.loads().stiffness()[0],
              1e-3);
  Planes3 above = cloth.rest;
  above.set(20, above.at(20) + Vec3f{0, 0.02F, 0});
  EXPECT_EQ(springs.forces(above).at(20), Vec3f{});
}

TEST(ContactSprings, DoNotShootOutWhatWasDeepWhenTheStepBegan) {
  const Cloth cloth = sheet_cloth(9);
  const Vec3f surface_displacement{0, 0.001F,
                                   0};  // the floor comes up by 1 mm, so only 9 mm are old
  Springs springs(cloth, {{{20}, {1}, up, 0.01F, 0, surface_displacement}});
  springs.springs.set_contacts(springs.contacts, cloth.rest, 0.006);
  springs.update_active(cloth.rest);
  EXPECT_NEAR(springs.forces(cloth.rest).y(2, 2), 0.004 * springs.springs.loads().stiffness()[0],
              1e-2);
}

TEST(ContactSprings, FrictionHoldsUpToItsCoefficientTimesTheForce) {
  const Cloth cloth = sheet_cloth(9);
  Springs springs(cloth, {{{20}, {1}, up, 0, 0.5F, {}}});
  const Planes3 none(9);
  const double h = 1.0 / 240, fall = 9.81 * h * h;
  const auto friction = [&](double tangent) {
    springs.springs.set_contacts(springs.contacts, cloth.rest, h);
    Planes3 place = cloth.rest;
    const auto down = static_cast<float>(fall), aside = static_cast<float>(tangent * fall);
    place.set(20, place.at(20) + Vec3f{aside, -down, 0});
    springs.update_active(place);
    springs.team.run([&](Worker& worker) {
      springs.springs.update_friction({place, none, none}, worker);
    });
    return springs.forces(place).at(20);
  };
  const double weight = 9.81 * double{cloth.mass(2, 2)};
  // What may slip is pulled back by the coefficient times the force that would stop its fall.
  EXPECT_NEAR(friction(0.8).x, -0.5 * weight, 1e-3 * weight);
  // What may be held is held by a spring that takes it all the way back.
  EXPECT_LT(friction(0.4).x, -weight);
  EXPECT_EQ(friction(0).x, 0);
}

TEST(ContactSprings, HeedWhatPressesWhenOneSideIsStopped) {
  const int n = 9;
  const Cloth cloth = sheet_cloth(n);
  // Particle 20 one millimetre above 60, both falling: only once 60 is stopped do they meet.
  Planes3 start = cloth.rest;
  start.set(20, {0, 0.003F, 0});
  start.set(60, {0, 0, 0});
  const Contact pair{{20, 60}, {1, -1}, up, 0.002F, 0, {}};
  Springs springs(cloth, {pair});
  springs.springs.set_contacts(springs.contacts, start, 1.0 / 240);
  Planes3 fallen = start;
  for (const int s : {20, 60}) fallen.set(s, fallen.at(s) - Vec3f{0, 0.0005F, 0});
  EXPECT_FALSE(springs.update_active(fallen));
  EXPECT_TRUE(springs.springs.empty());
  for (const int s : {20, 60}) fallen.set(s, fallen.at(s) - Vec3f{0, 0.001F, 0});
  EXPECT_TRUE(springs.update_active(fallen));
  EXPECT_FALSE(springs.update_active(fallen));
  EXPECT_FALSE(springs.springs.empty());
}

TEST(ContactSprings, BlocksBoundWhatForcesChangeBy) {
  const int n = 9;
  for (const Cloth& cloth : {sheet_cloth(n), make_cloth(flat_sheet(n), torus_mates(n), {})}) {
    Springs springs(cloth, mixed_contacts(n));
    std::array<Grid<float>, 6> block;
    for (Grid<float>& plane : block) plane = Grid<float>(n, n);
    for (int r = 0; r < n; ++r)
      springs.springs.loads().add_blocks(r, {block[0].row(r), block[1].row(r), block[2].row(r),
                                             block[3].row(r), block[4].row(r), block[5].row(r)});
    const Planes3 before = springs.forces(cloth.rest);
    for (int seed = 1; seed < 20; ++seed) {
      Planes3 place = cloth.rest;
      shake(cloth, 1e-3, place, seed);
      const Planes3 after = springs.forces(place);
      double change = 0, bound = 0;
      for (int s = 0; s < n * n; ++s) {
        const Vec3d d = vec_cast<double>(place.at(s) - cloth.rest.at(s));
        const auto of = [&](int i) { return double{block[i](s / n, s % n)}; };
        bound += dot(
            d, {of(0) * d.x + of(1) * d.y + of(2) * d.z, of(1) * d.x + of(3) * d.y + of(4) * d.z,
                of(2) * d.x + of(4) * d.y + of(5) * d.z});
        if (cloth.owner(s / n, s % n) > 0)
          change += dot(d, vec_cast<double>(before.at(s) - after.at(s)));
      }
      EXPECT_GT(change, 0);
      EXPECT_LT(change, bound);
    }
  }
}

}  // namespace
}  // namespace weft
