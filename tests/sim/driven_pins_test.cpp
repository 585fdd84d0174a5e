#include "weft/sim/motion/driven_pins.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "tests/sim/falling_sheet.h"
#include "weft/geometry_image.h"
#include "weft/image/builtin.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

constexpr int pulled_size = 9;
constexpr double pulled_cell = 1.0 / 8, pulled_substep = 0.01;

SimulatedCloth sheet_at_rest() {
  SimulatedCloth sheet;
  sheet.image = make_image_shape("sheet", pulled_size);
  sheet.model = std::make_shared<Cloth>(
      make_cloth(placed_positions(sheet.image, placement_map({{1, 1, 1}, {}, {}})),
                 BorderMates(pulled_size, {}), {}));
  sheet.state = rest_state(*sheet.model);
  return sheet;
}

/// A sheet whose corner is pulled by 8 m/s from the start.
struct PulledSheet {
  /// Where the corner is to be at the end of a step.
  double follow(double begin, double seconds) {
    driven.follow({begin, begin + seconds, {}, {}}, cloth);
    return cloth.model->pins[0].target.x - rest_place;
  }
  void put_corner(double x) {
    Vec3f place = cloth.state.position.at(0);
    place.x = static_cast<float>(rest_place + x);
    cloth.state.position.set(0, place);
  }

  SimulatedCloth cloth = sheet_at_rest();
  std::vector<PinMotion> paths = pin_places(
      *cloth.model, std::vector{ScenePin(ImagePin{{0, 0}}, {{0, {}, {}}, {1, {}, {8, 0, 0}}})});
  DrivenPins driven{paths, {}, {}, *cloth.model};
  double rest_place = -0.5;
};

TEST(DrivenPins, GoAlongTheirPaths) {
  PulledSheet sheet;
  for (const double seconds : {0.01, 0.0025})
    EXPECT_NEAR(sheet.follow(0, seconds), 8 * seconds, 1e-12);
}

TEST(DrivenPins, MakeUpAtAHandsSpeedForWhatHeldThemBack) {
  PulledSheet sheet;
  constexpr double begin = 0.5, held_back = 0.25;
  sheet.put_corner(8 * begin - held_back);
  for (const double seconds : {0.01, 1e-5})
    EXPECT_NEAR(sheet.follow(begin, seconds), 8 * begin - held_back + (8 + 3) * seconds, 1e-6);
  EXPECT_NEAR(sheet.follow(begin, 0.1), 8 * (begin + 0.1), 1e-6);  // time enough
}

TiedPin tied(int pin) {
  TiedPin tie;
  tie.pin = pin;
  return tie;
}

/// A sheet with a corner tied to a body that stands, 0.2 m above where collisions hold it back.
struct HeldBack {
  void follow(double seconds) { driven.follow({0, seconds, standing, standing}, cloth); }
  Vec3d& target() { return cloth.model->pins[0].target; }

  SimulatedCloth cloth = sheet_at_rest();
  Vec3d held = vec_cast<double>(cloth.state.position.at(0)), place = held + Vec3d{0, 0.2, 0};
  TiedPin tie = tied(pin(*cloth.model, 0, place));
  std::array<const Planes3*, 1> standing{};
  DrivenPins driven{{}, std::span(&tie, 1), standing, *cloth.model};
};

TEST(DrivenPins, ThoseThatStandReturnAtAHandsSpeed) {
  HeldBack sheet;
  for (int step = 0; step < 3; ++step) {  // each from where it is held
    sheet.follow(0.01);
    EXPECT_NEAR(sheet.target().y, sheet.held.y + 3 * 0.01, 1e-12);
  }
  sheet.driven.return_standing(*sheet.cloth.model);  // as it is saved
  EXPECT_EQ(sheet.target(), sheet.place);
  sheet.follow(0.1);
  EXPECT_EQ(sheet.target(), sheet.place);
}

TEST(DrivenPins, ThoseThatStandStayWhereAHandPutsThem) {
  HeldBack sheet;
  sheet.follow(0.01);
  const Vec3d put = sheet.place + Vec3d{0.1, 0, 0};
  sheet.target() = put;
  sheet.driven.return_standing(*sheet.cloth.model);
  EXPECT_EQ(sheet.target(), put);
  sheet.follow(0.1);
  EXPECT_EQ(sheet.target(), put);
}

TEST(DrivenPins, AskForStepsInWhichTheyDoNotOutrunTheCloth) {
  PulledSheet sheet;
  sheet.follow(0, pulled_substep);
  EXPECT_NEAR(sheet.driven.wanted_subdivisions(sheet.cloth, pulled_substep),
              8 * pulled_substep / (max_pin_lead * pulled_cell), 1e-6);
}

TEST(DrivenPins, AskForNoShorterStepsWhereTheClothComesAlong) {
  PulledSheet sheet;
  sheet.follow(0, pulled_substep);
  for (int s = 0; s < pulled_size * pulled_size; ++s) sheet.cloth.state.velocity.set(s, {8, 0, 0});
  EXPECT_LT(sheet.driven.wanted_subdivisions(sheet.cloth, pulled_substep), 1e-3);
}

/// Springs stretched by several cells in a step once flung its corners away at 7 km/s.
TEST(Simulation, ASheetPulledAwayComesAlong) {
  Scene scene;
  scene.ground.reset();
  scene.cloths = {testing::sheet(33, {0, 1, 0})};
  const std::vector<MotionKey> path{{0.05, {}, {}}, {0.25, {}, {5, 0, 0}}};
  scene.cloths[0].pins = {ScenePin(ImagePin{{0, 0}}, path), ScenePin(ImagePin{{1, 0}}, path)};
  Simulation simulation(scene, "pulled", 1);
  double largest_strain = 0;
  for (int frame = 0; frame < 8; ++frame)
    largest_strain = std::max(largest_strain, simulation.advance().strain.p99);
  EXPECT_LT(largest_strain, 0.3);
  EXPECT_NEAR(simulation.cloths()[0].state.position.at(0, 0).x, -0.5 + 25 * (8 / 60.0 - 0.05),
              1e-5);
}

}  // namespace
}  // namespace weft
