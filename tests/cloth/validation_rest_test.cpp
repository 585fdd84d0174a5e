#include <gtest/gtest.h>

#include "tests/cloth/validation.h"

namespace weft {
namespace {

using namespace testing;

struct Tip {
  double drop = 0, reach = 0;  ///< over the free length
  double kinetic_energy = 0;   ///< over m g times 1 m
};

/// A quarter of the stiffness across a strip that is cut along its warp or its weft.
WarpWeft bending_of(bool along_weft, double bending) {
  return along_weft ? WarpWeft(bending / 4, bending) : WarpWeft(bending, bending / 4);
}

Planes3 transposed(const Planes3& p) {
  Planes3 result(p.size());
  for (int r = 0; r < p.size(); ++r)
    for (int c = 0; c < p.size(); ++c) result.set(r, c, p.at(c, r));
  return result;
}

/// Wide, so that its middle bends as a cylinder does; a narrow one gives way across as well.
constexpr double strip_length = 0.3, strip_width = 4 * strip_length;
constexpr double seconds_to_rest = 5;

/// A level strip clamped by its first two columns, or with its weft along x by its first two rows.
Cloth clamped_strip(const Material& material, int n, bool along_weft) {
  const Planes3 strip = flat_strip(n, strip_length, strip_width);
  Cloth cloth = make_cloth(along_weft ? transposed(strip) : strip, no_mates(n), material);
  for (int across = 0; across < n; ++across)
    for (const int along : {0, 1})
      pin_at(cloth, along_weft ? along : across, along_weft ? across : along, cloth.rest);
  return cloth;
}

struct Strip {
  int n = 25;
  bool woven = false, along_weft = false;
};

/// Where a heavy strip comes to rest: its bending starts halfway between the clamped lines.
/// @param load  area density * g L^3 / B
Tip hang_cantilever(double load, const Strip& strip, const Way& way) {
  const int n = strip.n;
  const double spacing = strip_length / (n - 1), free = strip_length - 0.5 * spacing;
  Material material{.density = 0.2, .stretch = 2e4, .shear = 5e3, .damping = 0};
  const double bending = material.density * 9.81 * free * free * free / load;
  material.bending = strip.woven ? bending_of(strip.along_weft, bending) : bending;
  const Cloth cloth = clamped_strip(material, n, strip.along_weft);
  ClothState state = rest_state(cloth);
  const double kinetic = come_to_rest(cloth, way, seconds_to_rest, state);
  const Vec3f tip =
      strip.along_weft ? state.position.at(n - 1, n / 2) : state.position.at(n / 2, n - 1);
  return {-tip.y / free, (tip.x - 0.5 * spacing) / free, kinetic};
}

/// The heavy elastica's boundary value problem, solved to all digits given.
struct HeavyElastica {
  double load = 0, drop = 0, reach = 0;
};

void check_tip(const std::string& what, const Tip& wanted, const Tip& tip) {
  check(what + ": drop/L", wanted.drop, tip.drop, 0.01 * wanted.drop);
  check(what + ": x/L", wanted.reach, tip.reach, 0.01 * wanted.reach);
  // A thousand times as stiff as cloth, it trembles more than that where iterations are few.
  check(what + ": kinetic energy at rest, m g L", 0, tip.kinetic_energy, 10 * still_energy);
}

void compare(const HeavyElastica& wanted, int n, const Way& way = defaults) {
  check_tip(fmt::format("cantilever, G = {}", wanted.load) + way.suffix(),
            {wanted.drop, wanted.reach}, hang_cantilever(wanted.load, {n}, way));
}

TEST(ValidationRest, CantileverIsTheHeavyElastica) {
  compare({1, 0.123471, 0.991246}, 25);
  compare({8, 0.640631, 0.724425}, 25);
  compare({8, 0.640631, 0.724425}, 25, tight);
}

TEST(ValidationRest, DISABLED_LongCantileverIsTheHeavyElastica) {
  compare({16, 0.797020, 0.509995}, 33);
  compare({40, 0.894643, 0.283519}, 33);
  compare({100, 0.937524, 0.159223}, 33);
}

TEST(ValidationRest, WovenStripsBendByTheThreadsAlongThem) {
  for (const bool along_weft : {false, true})
    check_tip(std::string("cantilever along the ") + (along_weft ? "weft" : "warp") + ", G = 8",
              {0.640631, 0.724425}, hang_cantilever(8, {25, true, along_weft}, defaults));
}

TEST(ValidationRest, CantileverTestFindsTheBendingLength) {
  // An overhang of twice the bending length points down by 41.5 degrees [astmd1388].
  const Tip tip = hang_cantilever(8, {25}, defaults);
  const double angle = 180 / pi * arc_tangent(tip.drop, tip.reach);
  check("ASTM D1388: angle of an overhang of 2 c [degrees]", 41.5, angle, 0.01 * 41.5);
}

struct Catenary {
  double sag = 0, tension = 0;  ///< over its length, over its weight
  double kinetic_energy = 0;    ///< over m g times 1 m
};

/// A sheet between two level edges, by its middle and by what its columns pull with.
Catenary hang_between(double span, const Way& way) {
  const int n = 49;
  Cloth cloth = make_cloth(flat_strip(n, 1, 0.5), no_mates(n),
                           {.density = 0.2, .stretch = 5e3, .shear = 100, .bending = 0});
  ClothState state = rest_state(cloth);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double s = c / (n - 1.0);
      state.position.set(r, c, vec_cast<float>(Vec3d{span * s, -s * (1 - s), 0.5 * r / (n - 1)}));
    }
  for (int r = 0; r < n; ++r)
    for (const int c : {0, n - 1}) pin_at(cloth, r, c, state.position);
  const double kinetic = come_to_rest(cloth, way, seconds_to_rest, state);
  // All columns pull alike along x, so rounding averages out; each end holds half the weight.
  const SpringPlane& plane = cloth.springs[stretch_u];
  double pull = 0;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c + 1 < n; ++c) {
      const Vec3f link = state.position.at(r, c + 1) - state.position.at(r, c);
      const double strained = length(link) - plane.rest_length(r, c);
      pull += plane.stiffness(r, c) * strained * link.x / length(link) / (n - 1);
    }
  const double relative = pull / (9.81 * total_mass(cloth));
  return {-state.position.y(n / 2, n / 2), std::sqrt(relative * relative + 0.25), kinetic};
}

void check_catenary(double span, double sag, const Way& way = defaults) {
  const std::string what = fmt::format("catenary, span/L = {}", span) + way.suffix();
  const Catenary measured = hang_between(span, way);
  check(what + ": sag/L", sag, measured.sag, 1e-3);
  check(what + ": kinetic energy at rest, m g L", 0, measured.kinetic_energy, still_energy);
  if (span == 0.8)
    check(what + ": tension at its end over weight", 0.603639, measured.tension, 0.006);
}

TEST(ValidationRest, SheetBetweenTwoEdgesIsACatenary) {
  check_catenary(0.5, 0.39819418);
  check_catenary(0.8, 0.26543751);
  check_catenary(0.8, 0.26543751, tight);
  check_catenary(0.9, 0.19070900);
}

/// A square that hangs from four points of it, halfway between its middle and its corners: it sags
/// between them and droops outside.
struct Draped {
  double mean_drop = 0, corner_drop = 0;  ///< over the half width
  double kinetic_energy = 0;              ///< over m g times 1 m
};

/// Where sample (u, v) lies on the square of side 1; uneven and sheared, but for the four points.
Vec2d uneven_place(double u, double v) {
  const double both = sine(4 * pi * u) * sine(4 * pi * v);
  return {u + 0.02 * sine(4 * pi * u) + 0.015 * both, v - 0.015 * sine(4 * pi * v) + 0.01 * both};
}

Draped drape(int n, bool uneven, const Way& way = defaults) {
  const double side = 0.6;
  Planes3 rest(n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) {
      const double u = c / (n - 1.0), v = r / (n - 1.0);
      const Vec2d at = uneven ? uneven_place(u, v) : Vec2d{u, v};
      rest.set(r, c, vec_cast<float>(Vec3d{side * (at.x - 0.5), 0, side * (at.y - 0.5)}));
    }
  Cloth cloth = make_cloth(rest, no_mates(n),
                           {.density = 0.41, .stretch = 500, .shear = 150, .bending = 2e-3});
  for (const int r : {(n - 1) / 4, 3 * (n - 1) / 4})
    for (const int c : {(n - 1) / 4, 3 * (n - 1) / 4}) pin_at(cloth, r, c, rest);
  ClothState state = rest_state(cloth);
  const double kinetic = come_to_rest(cloth, way, seconds_to_rest, state);
  return {-centre_of_mass(cloth, state).y / (side / 2), -state.position.y(0, 0) / (side / 2),
          kinetic};
}

void compare_drapes(const std::string& what, const Draped& wanted, const Draped& measured,
                    double tolerance = 0.02) {
  check(what + ": mean drop over half its width", wanted.mean_drop, measured.mean_drop,
        tolerance * wanted.mean_drop);
  check(what + ": drop of a corner over half its width", wanted.corner_drop, measured.corner_drop,
        tolerance * wanted.corner_drop);
  check(what + ": kinetic energy at rest, m g L", 0, measured.kinetic_energy, still_energy);
}

TEST(ValidationRest, ClothDrapesAlikeAtEveryResolutionAndParameterization) {
  const Draped even = drape(65, false);
  EXPECT_GT(even.corner_drop, 0.1);
  const Draped coarse = drape(33, false);
  compare_drapes("draped square, n = 33 against 65", even, coarse);
  compare_drapes("draped square, n = 33 against a tight solve", drape(33, false, tight), coarse,
                 0.01);
  compare_drapes("draped square, uneven n = 33 against 65", even, drape(33, true));
}

TEST(ValidationRest, DISABLED_FineClothDrapesAlike) {
  const Draped finest = drape(129, false);
  compare_drapes("draped square, n = 65 against 129", finest, drape(65, false));
  compare_drapes("draped square, uneven n = 65 against 129", finest, drape(65, true));
}

}  // namespace
}  // namespace weft
