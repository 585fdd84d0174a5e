#include "weft/cloth/bending.h"

#include <functional>

#include <gtest/gtest.h>

#include "tests/cloth/sheets.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"

namespace weft {
namespace {

using namespace testing;

const Material stiff{.bending = 1e-3};
/// Nine times stiffer along the warp.
const Material woven{.bending = {1e-3, 1e-3 / 9}};

/// A flat square whose samples are unevenly spread and whose grid lines are not at right angles.
Planes3 uneven_sheet(int n) {
  Planes3 p(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double u = c / (n - 1.0), v = r / (n - 1.0);
      const double x = u + 0.06 * sine(2 * pi * u) + 0.05 * sine(pi * u) * sine(2 * pi * v);
      const double z = v - 0.05 * sine(pi * v) * sine(pi * (u + 0.3));
      p.set(r, c, vec_cast<float>(Vec3d{x - 0.5, 0, z - 0.5}));
    }
  return p;
}

/// A flat disk: the border of the image is a circle, its corners lie on it like all else.
Planes3 disk(int n) {
  Planes3 p(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double x = 2.0 * c / (n - 1) - 1, z = 2.0 * r / (n - 1) - 1;
      const double out = std::max(std::abs(x), std::abs(z)), round = std::sqrt(x * x + z * z);
      const double scale = round > 0 ? 0.5 * out / round : 0;
      p.set(r, c, vec_cast<float>(Vec3d{scale * x, 0, scale * z}));
    }
  return p;
}

Cloth flat_cloth(const Planes3& rest, const Material& material = stiff) {
  return make_cloth(rest, no_mates(rest.size()), material);
}

Planes3 mapped(const Planes3& from, const std::function<Vec3d(Vec3d)>& map) {
  Planes3 to(from.size());
  for (int s = 0; s < from.size() * from.size(); ++s)
    to.set(s, vec_cast<float>(map(vec_cast<double>(from.at(s)))));
  return to;
}

Vec3d turned(Vec3d p) {
  const Vec3d x = normalized(Vec3d{1, 2, -1}), y = normalized(cross(x, Vec3d{0, 1, 1}));
  return p.x * x + p.y * y + p.z * cross(x, y) + Vec3d{0.3, -0.2, 0.5};
}

/// Each particle's whole bending force, or what a change from rest makes of it.
Planes3 forces(const Cloth& cloth, const Planes3& position, bool change = false, int threads = 1) {
  Planes3 out(cloth.size);
  BendingPass pass(cloth);
  ThreadTeam team(threads);
  team.run([&](Worker& worker) {
    pass.curve(change ? cloth.rest : position, worker);
    if (change) pass.curve_change(position, worker);
    const Range mine = worker.share(cloth.size);
    for (int r = mine.first; r < mine.last; ++r) pass.add_row(1, r, out);
    worker.barrier();
    sum_over_mates(cloth.mates, worker, {&out.x, &out.y, &out.z});
  });
  return out;
}

double largest(const Planes3& planes) {
  double most = 0;
  for (int s = 0; s < planes.size() * planes.size(); ++s)
    most = std::max(most, length(vec_cast<double>(planes.at(s))));
  return most;
}

double dot_product(const Cloth& cloth, const Planes3& a, const Planes3& b) {
  double sum = 0;
  for (int s = 0; s < cloth.size * cloth.size; ++s)
    sum += double{cloth.owner(s / cloth.size, s % cloth.size)} *
           dot(vec_cast<double>(a.at(s)), vec_cast<double>(b.at(s)));
  return sum;
}

/// What the forces make of moving particles by a micrometre, which rounding must stay below.
double force_of_a_hair(const Cloth& cloth) {
  Planes3 p(cloth.size);
  shake(cloth, 1e-6, p);
  return largest(forces(cloth, p, true));
}

TEST(Bending, AffineMapsOfFlatClothFeelNone) {
  const auto affine = [](Vec3d p) {
    return Vec3d{1.3 * p.x + 0.2 * p.z, 0.4 * p.x - 0.7 * p.z + 0.1, 0.8 * p.z - 0.3 * p.x};
  };
  for (const Material& material : {stiff, woven})
    for (const Planes3& rest : {flat_sheet(17), uneven_sheet(17), disk(17)}) {
      const Cloth cloth = flat_cloth(rest, material);
      EXPECT_FALSE(cloth.bending.curved);
      EXPECT_LT(largest(forces(cloth, mapped(rest, affine))), force_of_a_hair(cloth));
    }
}

TEST(Bending, LaplacianDoesNotDependOnTheParameterization) {
  // y = x^2 / 2 + x z / 3 + z^2 has the Laplacian 3 and the Gaussian curvature 2 - 1/9.
  const auto bowl = [](Vec3d p) {
    return Vec3d{p.x, 0.5 * p.x * p.x + p.x * p.z / 3 + p.z * p.z, p.z};
  };
  for (const Planes3& rest : {flat_sheet(65), uneven_sheet(65), disk(65)}) {
    const Cloth cloth = flat_cloth(rest);
    const double area = total_mass(cloth) / cloth.material.density;
    const double energy = bending_energy(cloth, mapped(rest, bowl));
    // Along the border only the second derivative there counts.
    const double density = 0.5 * stiff.bending.warp * (9 - 2 * 0.75 * (2 - 1.0 / 9));
    EXPECT_NEAR(energy / (density * area), 1, 0.05);
  }
}

TEST(Bending, RegularGridNeedsItsStraightNeighboursAlone) {
  EXPECT_FALSE(flat_cloth(flat_sheet(41)).bending.diagonals);
  EXPECT_TRUE(flat_cloth(uneven_sheet(41)).bending.diagonals);
}

TEST(Bending, RolledStripHasTheEnergyOfItsCurvature) {
  // A cylinder of radius 1/2: B/2 4 on all of the area but half a row at either end.
  const int n = 33;
  const Cloth cloth = flat_cloth(flat_sheet(n));
  const auto roll = [](Vec3d p) { return Vec3d{0.5 * sine(2 * p.x), -0.5 * cosine(2 * p.x), p.z}; };
  const double energy = bending_energy(cloth, mapped(cloth.rest, roll));
  const double wanted = 0.5 * stiff.bending.warp * 4 * (1 - 1.0 / (n - 1));
  EXPECT_NEAR(energy / wanted, 1, 1e-3);
}

/// Rows along x, columns 30 degrees off z.
Planes3 skew_sheet(int n) {
  return mapped(flat_sheet(n), [](Vec3d p) { return Vec3d{p.x + 0.5 * p.z, 0, p.z}; });
}

/// Rows along (cos, sin) of an angle of 30 degrees in the plane of x and z.
constexpr double row_x = 0.86602540378443865, row_z = 0.5;
Planes3 turned_sheet(int n) {
  return mapped(flat_sheet(n), [](Vec3d p) {
    return Vec3d{row_x * p.x - row_z * p.z, 0, row_z * p.x + row_x * p.z};
  });
}

/// The stiffness B of a cloth rolled onto a cylinder of radius 1/2 that bends x, or z, from its
/// energy B/2 4 on all of its area.
double rolled_stiffness(const Cloth& cloth, bool bends_x) {
  const auto roll = [&](Vec3d p) {
    const double along = bends_x ? p.x : p.z, rest = bends_x ? p.z : p.x;
    return Vec3d{0.5 * sine(2 * along), -0.5 * cosine(2 * along), rest};
  };
  const double area = total_mass(cloth) / cloth.material.density;
  return bending_energy(cloth, mapped(cloth.rest, roll)) / (0.5 * 4 * area);
}

TEST(Bending, CylindersBendTheirWarpOrTheirWeft) {
  const int n = 33;
  const double inner = 1 - 1.0 / (n - 1);  // half a row at either end is not bent
  const Cloth cloth = flat_cloth(flat_sheet(n), woven);
  EXPECT_NEAR(rolled_stiffness(cloth, true) / (woven.bending.warp * inner), 1, 1e-3);
  EXPECT_NEAR(rolled_stiffness(cloth, false) / (woven.bending.weft * inner), 1, 1e-3);
}

TEST(Bending, WarpFollowsTheRowsAndWeftIsAtRightAnglesToThem) {
  const Cloth skew = flat_cloth(skew_sheet(65), woven);
  EXPECT_NEAR(rolled_stiffness(skew, true) / woven.bending.warp, 1, 0.05);
  EXPECT_NEAR(rolled_stiffness(skew, false) / woven.bending.weft, 1, 0.05);
}

TEST(Bending, BiasIsBetweenWarpAndWeft) {
  // sqrt(B) in a direction: that of the warp times its cosine squared, and of the weft by the sine.
  const Cloth cloth = flat_cloth(turned_sheet(65), woven);
  const double warp = std::sqrt(woven.bending.warp), weft = std::sqrt(woven.bending.weft);
  const double along_x = warp * 0.75 + weft * 0.25, along_z = warp * 0.25 + weft * 0.75;
  EXPECT_NEAR(rolled_stiffness(cloth, true) / (along_x * along_x), 1, 0.05);
  EXPECT_NEAR(rolled_stiffness(cloth, false) / (along_z * along_z), 1, 0.05);
}

TEST(Bending, WovenBowlHasTheEnergyOfBothCurvatures) {
  // y = x^2 / 2 + x z / 3 + z^2: second derivatives 1 and 2, the Gaussian curvature 2 - 1/9.
  const auto bowl = [](Vec3d p) {
    return Vec3d{p.x, 0.5 * p.x * p.x + p.x * p.z / 3 + p.z * p.z, p.z};
  };
  const double warp = std::sqrt(woven.bending.warp), weft = std::sqrt(woven.bending.weft);
  const double sum = warp + 2 * weft;
  const double density = 0.5 * sum * sum - 0.75 * warp * weft * (2 - 1.0 / 9);
  for (const Planes3& rest : {flat_sheet(65), skew_sheet(65)}) {
    const Cloth cloth = flat_cloth(rest, woven);
    const double area = total_mass(cloth) / cloth.material.density;
    EXPECT_NEAR(bending_energy(cloth, mapped(rest, bowl)) / (density * area), 1, 0.05);
  }
}

TEST(Bending, ExchangedThreadsAreATransposedCloth) {
  const int n = 17;
  const Planes3 rest = uneven_sheet(n);
  Planes3 transposed(n), p(n), q(n);
  const Cloth one = flat_cloth(flat_sheet(n), woven);
  for (int s = 0; s < n * n; ++s) transposed.set(s % n * n + s / n, one.rest.at(s));
  const Cloth other = flat_cloth(transposed, {.bending = {1e-3 / 9, 1e-3}});
  p = rest;
  shake(one, 0.01, p);
  for (int s = 0; s < n * n; ++s) q.set(s % n * n + s / n, p.at(s));
  const double energy = bending_energy(one, p);
  EXPECT_NEAR(bending_energy(other, q), energy, 1e-5 * energy);
}

TEST(Bending, SaddleHasTheEnergyOfItsTwist) {
  // z = c x y bends nowhere on average; three quarters of its twist count: (1 - nu) B c^2 area.
  const auto saddle = [](Vec3d p) { return Vec3d{p.x, 0.8 * p.x * p.z, p.z}; };
  const auto relative_energy = [&](const Planes3& rest) {
    const Cloth cloth = flat_cloth(rest);
    const double area = total_mass(cloth) / cloth.material.density;
    return bending_energy(cloth, mapped(rest, saddle)) / (0.75 * stiff.bending.warp * 0.64 * area);
  };
  EXPECT_NEAR(relative_energy(flat_sheet(9)), 1, 1e-4);
  EXPECT_NEAR(relative_energy(uneven_sheet(33)), 1, 0.05);
  EXPECT_NEAR(relative_energy(disk(33)), 1, 0.05);
}

TEST(Bending, NoShapeHasNegativeEnergy) {
  // The lowest eigenvalue, by the powers of what the highest one is more than the matrix.
  const auto narrow = [](Vec3d p) { return Vec3d{p.x, 0, 0.25 * p.z}; };
  std::vector<Cloth> cloths{flat_cloth(flat_sheet(9), woven), flat_cloth(uneven_sheet(9), woven)};
  for (const Planes3& rest :
       {flat_sheet(9), uneven_sheet(9), disk(9), uneven_sheet(17), mapped(flat_sheet(9), narrow)})
    cloths.push_back(flat_cloth(rest));
  for (const Cloth& cloth : cloths) {
    Planes3 displacement(cloth.size);
    shake(cloth, 1, displacement);
    const auto normalize = [&](Planes3& planes) {
      const auto scale = static_cast<float>(1 / std::sqrt(dot_product(cloth, planes, planes)));
      for (int s = 0; s < cloth.size * cloth.size; ++s) planes.set(s, scale * planes.at(s));
    };
    const auto power = [&](double shift, int count) {
      double value = 0;
      for (int i = 0; i < count; ++i) {
        normalize(displacement);
        const Planes3 image = forces(cloth, displacement, true);
        value = -dot_product(cloth, displacement, image);
        for (int s = 0; s < cloth.size * cloth.size; ++s)
          displacement.set(s, static_cast<float>(shift) * displacement.at(s) + image.at(s));
      }
      return value;
    };
    const double highest = power(0, 50);
    shake(cloth, 1, displacement, 2);
    EXPECT_GT(power(0.6 * highest, 2000), -1e-5 * highest);
  }
}

void move(const Cloth& cloth, int sample, Vec3f by, Planes3& planes) {
  const int first = cloth.mates.representative(sample);
  for (int s = 0; s < cloth.size * cloth.size; ++s)
    if (cloth.mates.representative(s) == first) planes.set(s, planes.at(s) + by);
}

TEST(Bending, ForcesAreMinusTheGradient) {
  for (const Cloth& cloth : {flat_cloth(uneven_sheet(9)), torus_cloth(9, stiff),
                             flat_cloth(uneven_sheet(9), woven), torus_cloth(9, woven)}) {
    Planes3 p = cloth.rest;
    shake(cloth, 0.03, p);
    const Planes3 force = forces(cloth, p);
    const float step = 0x1p-10F;
    for (const int sample : {0, 4, 9, 10, 40, 44, 71, 79})
      for (const Vec3f displacement : {Vec3f{step, 0, 0}, Vec3f{0, step, 0}, Vec3f{0, 0, step}}) {
        Planes3 ahead = p, behind = p;
        move(cloth, sample, displacement, ahead);
        move(cloth, sample, -displacement, behind);
        const double slope =
            (bending_energy(cloth, ahead) - bending_energy(cloth, behind)) / (2.0 * step);
        const double along =
            dot(vec_cast<double>(force.at(sample)), vec_cast<double>(displacement)) / step;
        EXPECT_NEAR(along, -slope, 1e-3 * largest(force)) << "sample " << sample;
      }
  }
}

TEST(Bending, TurnedTorusFeelsNone) {
  for (const Material& material : {stiff, woven}) {
    const Cloth cloth = torus_cloth(33, material);
    EXPECT_TRUE(cloth.bending.curved);
    EXPECT_LT(largest(forces(cloth, cloth.rest)), force_of_a_hair(cloth));
    const double left = largest(forces(cloth, mapped(cloth.rest, turned)));
    EXPECT_LT(left, force_of_a_hair(cloth));
    const auto wider = [](Vec3d p) { return 1.1 * p; };
    EXPECT_GT(largest(forces(cloth, mapped(cloth.rest, wider))), 10 * left);
  }
}

TEST(Bending, TurnedFlatClothStaysFlat) {
  const Planes3 rest = mapped(flat_sheet(65), turned);
  EXPECT_FALSE(flat_cloth(rest).bending.curved);
}

TEST(Bending, ForcesOfOneClothAddUpToNone) {
  for (const Cloth& cloth :
       {flat_cloth(uneven_sheet(17)), torus_cloth(17, stiff), torus_cloth(17, woven)}) {
    Planes3 p = cloth.rest;
    shake(cloth, 0.01, p);
    const Planes3 force = forces(cloth, p);
    Vec3d sum;
    for (int s = 0; s < cloth.size * cloth.size; ++s)
      sum += double{cloth.owner(s / cloth.size, s % cloth.size)} * vec_cast<double>(force.at(s));
    EXPECT_LT(length(sum), 1e-4 * largest(force));
  }
}

TEST(Bending, ForcesTurnNothing) {
  for (const Cloth& cloth :
       {flat_cloth(uneven_sheet(17)), torus_cloth(17, stiff), torus_cloth(17, woven)}) {
    Planes3 p = cloth.rest;
    shake(cloth, 0.01, p);
    const Planes3 force = forces(cloth, p);
    Vec3d torque;
    for (int s = 0; s < 17 * 17; ++s)
      torque += double{cloth.owner(s / 17, s % 17)} *
                cross(vec_cast<double>(p.at(s)), vec_cast<double>(force.at(s)));
    EXPECT_LT(length(torque), 1e-4 * largest(force));
  }
}

TEST(Bending, ChangeIsTheDerivativeAtRest) {
  for (const Cloth& cloth :
       {flat_cloth(uneven_sheet(17)), torus_cloth(17, stiff), torus_cloth(17, woven)}) {
    Planes3 displacement(17), ahead = cloth.rest, behind = cloth.rest;
    shake(cloth, 1, displacement, 2);
    const float step = 0x1p-12F;
    for (int s = 0; s < 17 * 17; ++s) {
      ahead.set(s, cloth.rest.at(s) + step * displacement.at(s));
      behind.set(s, cloth.rest.at(s) - step * displacement.at(s));
    }
    const Planes3 f1 = forces(cloth, ahead), f0 = forces(cloth, behind);
    const Planes3 image = forces(cloth, displacement, true);
    for (int s = 0; s < 17 * 17; ++s) {
      const Vec3f slope = (1 / (2 * step)) * (f1.at(s) - f0.at(s));
      EXPECT_LT(length(slope - image.at(s)), 5e-3 * largest(image)) << "sample " << s;
    }
  }
}

TEST(Bending, RotationsOfCurvedClothMeetNoResistance) {
  const Cloth cloth = torus_cloth(33, stiff);
  const Vec3f axis{1, 2, -1};
  Planes3 turn(33);
  for (int s = 0; s < 33 * 33; ++s) turn.set(s, cross(axis, cloth.rest.at(s)));
  Planes3 rough(33);
  shake(cloth, 1, rough);
  EXPECT_LT(largest(forces(cloth, turn, true)), 1e-5 * largest(forces(cloth, rough, true)));
}

TEST(Bending, BoundIsNotExceeded) {
  for (const Cloth& cloth :
       {flat_cloth(flat_sheet(9)), flat_cloth(uneven_sheet(9)), torus_cloth(9, stiff),
        flat_cloth(uneven_sheet(9), woven), torus_cloth(9, woven)}) {
    for (int seed = 1; seed <= 20; ++seed) {
      Planes3 displacement(9);
      shake(cloth, 1, displacement, seed);
      double bound = 0;
      for (int d = 0; d < spring_directions; ++d) {
        const Grid<float> edges = bending_bound(cloth, static_cast<SpringDirection>(d));
        const auto [down, right] = spring_offsets[d];
        for (int r = 0; r < 9; ++r)
          for (int c = 0; c < 9; ++c)
            if (edges(r, c) > 0)
              bound +=
                  edges(r, c) * squared_length(vec_cast<double>(
                                    displacement.at(r + down, c + right) - displacement.at(r, c)));
      }
      EXPECT_LT(-dot_product(cloth, displacement, forces(cloth, displacement, true)), bound);
    }
  }
}

TEST(Bending, CheckerboardMeetsItsBoundInside) {
  const Cloth cloth = flat_cloth(flat_sheet(9));
  const double d = 1.0 / 8;
  // One particle's part of M^T M of a checkerboard is B d^2 (8 / d^2)^2; of the edges, 8 k 8.
  const double exact = stiff.bending.warp * 64 / (d * d);
  EXPECT_NEAR(bending_bound(cloth, stretch_u)(4, 4) * 8, exact, 1e-4 * exact);
}

TEST(Bending, DiagonalIsThatOfTheMatrix) {
  Cloth torus = torus_cloth(9, stiff);
  torus.bending.curved = false;  // as if its normals did not turn
  for (const Cloth& cloth :
       {flat_cloth(uneven_sheet(9)), flat_cloth(uneven_sheet(9), woven), torus})
    for (const int sample : {0, 3, 8, 9, 12, 40, 63, 72, 80}) {
      const int first = cloth.mates.representative(sample);
      Planes3 unit(9);
      for (int s = 0; s < 81; ++s)
        if (cloth.mates.representative(s) == first) unit.set(s, {1, 0, 0});
      const double wanted = -forces(cloth, unit, true).x(first / 9, first % 9);
      EXPECT_NEAR(cloth.bending.diagonal(first / 9, first % 9), wanted, 1e-4 * wanted + 1e-9);
    }
}

TEST(Bending, AnyTeamGivesTheSameBits) {
  const Cloth cloth = torus_cloth(17, stiff);
  Planes3 p = cloth.rest;
  shake(cloth, 0.01, p);
  const auto hash = [&](int threads) {
    return hash_of({forces(cloth, p, false, threads), Planes3(17)});
  };
  EXPECT_EQ(hash(1), hash(3));
  EXPECT_EQ(hash(1), hash(7));
}

TEST(Bending, NoneWithoutStiffness) {
  const Cloth cloth = sheet_cloth(9, {.bending = 0});
  EXPECT_FALSE(BendingPass(cloth).active());
}

}  // namespace
}  // namespace weft
