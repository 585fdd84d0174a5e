#include <gtest/gtest.h>

#include "tests/cloth/validation.h"
#include "weft/core/math.h"
#include "weft/sim/simulation.h"

namespace weft {
namespace {

using namespace testing;

/// How far a sheet slides down a slope in a time, lying on it from the start. The slope is level
/// ground under turned gravity.
double slide(double tangent, double friction, double seconds, const IntegratorOptions& integrator) {
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
  Simulation simulation(scene, "slope", 1);
  const double start = simulation.centre_of_mass().x;
  const int frames = static_cast<int>(std::lround(seconds * scene.frame_rate));
  for (int frame = 0; frame < frames; ++frame) simulation.advance();
  return simulation.centre_of_mass().x - start;
}

TEST(ValidationIncline, ClothSticksOrSlidesByCoulombsLaw) {
  const double friction = 0.6, seconds = 0.5;
  for (const IntegratorOptions& integrator :
       {IntegratorOptions(ImplicitOptions{}), IntegratorOptions(MultigridOptions{})}) {
    const std::string name(name_of(integrator));
    check("slope of 0.5 at friction 0.6, " + name + ": way in 0.5 s [m]", 0,
          slide(0.5, friction, seconds, integrator), 0.002);
    const double tangent = 0.9, cosine = 1 / std::sqrt(1 + tangent * tangent);
    const double wanted = 9.81 * cosine * (tangent - friction) * seconds * seconds / 2;
    check("slope of 0.9 at friction 0.6, " + name + ": way in 0.5 s [m]", wanted,
          slide(tangent, friction, seconds, integrator), 0.05 * wanted);
  }
}

}  // namespace
}  // namespace weft
