#include <vector>

#include <gtest/gtest.h>

#include "tests/cloth/validation.h"
#include "weft/core/math.h"
#include "weft/simulation.h"

namespace weft {
namespace {

using namespace testing;

/// A sheet that lies on a slope from the start. The slope is level ground under turned gravity.
Scene slope(double tangent, double friction, const IntegratorOptions& integrator) {
  const double cosine = 1 / std::sqrt(1 + tangent * tangent), sine = tangent * cosine;
  constexpr double ground_friction = 0.5;
  Scene scene;
  scene.gravity = {9.81 * sine, -9.81 * cosine, 0};
  scene.integrator = integrator;
  SceneCloth cloth;
  cloth.size = 17;
  cloth.material = soft_fabric;
  cloth.placement.scale = {0.2, 1, 0.2};
  cloth.placement.translate = {0, 0.0061, 0};
  cloth.friction = friction * friction / ground_friction;  // coefficients meet in their mean
  scene.cloths = {cloth};
  return scene;
}

/// How far the sheet slides in a time after another [m].
double surface_displacement(const Scene& scene, double before, double seconds) {
  Simulation simulation(scene, "slope", 1);
  const auto frames_of = [&](double time) {
    return static_cast<int>(std::lround(time * scene.frame_rate));
  };
  for (int frame = 0; frame < frames_of(before); ++frame) simulation.advance();
  const double start = simulation.centre_of_mass().x;
  for (int frame = 0; frame < frames_of(seconds); ++frame) simulation.advance();
  return simulation.centre_of_mass().x - start;
}

constexpr double friction = 0.6, touchdown = 0.5;
const std::vector<IntegratorOptions> methods{NewtonOptions{}, ImplicitOptions{},
                                             MultigridOptions{}};

void check_creep(const IntegratorOptions& integrator, double seconds) {
  check(fmt::format("slope of 0.5 at friction 0.6, {}: way in {} s after touchdown [m]",
                    name_of(integrator), seconds),
        0, surface_displacement(slope(0.5, friction, integrator), touchdown, seconds), 2e-6);
}

TEST(ValidationIncline, ClothSlidesByCoulombsLaw) {
  const double seconds = 0.5, tangent = 0.9, cosine = 1 / std::sqrt(1 + tangent * tangent);
  const double wanted = 9.81 * cosine * (tangent - friction) * seconds * seconds / 2;
  for (const IntegratorOptions& integrator : methods)
    check(fmt::format("slope of 0.9 at friction 0.6, {}: way in 0.5 s [m]", name_of(integrator)),
          wanted, surface_displacement(slope(tangent, friction, integrator), 0, seconds),
          0.05 * wanted);
}

TEST(ValidationIncline, ClothSticksByCoulombsLaw) {
  for (const IntegratorOptions& integrator : methods) check_creep(integrator, 2);
}

TEST(ValidationIncline, DISABLED_ClothSticksForAMinute) {
  for (const IntegratorOptions& integrator : methods) check_creep(integrator, 60);
}

}  // namespace
}  // namespace weft
