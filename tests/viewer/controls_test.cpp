#include "apps/viewer/controls.h"

#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "tests/view/shapes.h"

namespace weft::viewer {
namespace {

class Hand : public ::testing::Test {
 protected:
  Hand() {
    auto subject = std::make_shared<Subject>();
    const Planes3 sheet = wavy_sheet(33, 0.4F);
    subject->cloths.push_back({"sheet", {}, std::nullopt, sheet, true});
    subject->scene.emplace();
    snapshot.cloths = {sheet};
    snapshot.subject = subject;
    camera.resize(800, 600, 0);
    camera.orbit({0, 120});  // from above, so that no wave hides another
    camera.frame(bounds(sheet));
    on_cloth = camera.pixel_of(vec_cast<double>(sheet.at(16, 16)));
  }
  void happen(const Event& event, bool over_panel = false) {
    controls.handle(event, snapshot, camera, over_panel);
  }
  void key(int key) { happen(KeyPressed{key}); }

  Snapshot snapshot;
  OrbitCamera camera;
  Controls controls{true};
  Vec2d on_cloth;
};

TEST_F(Hand, DraggingClothGrabsPullsAndLetsGo) {
  const Vec3d eye = camera.camera().eye;
  happen(MousePressed{MouseButton::left, on_cloth});
  happen(MouseMoved{on_cloth + Vec2d{0, -50}});
  ASSERT_TRUE(controls.held());
  happen(MouseReleased{MouseButton::left, on_cloth + Vec2d{0, -80}});
  EXPECT_FALSE(controls.held());
  const Wishes wishes = controls.take_wishes();
  ASSERT_EQ(wishes.commands.size(), 4U);
  EXPECT_EQ(std::get<Grab>(wishes.commands[0]).sample, 16 * 33 + 16);
  const Vec3d start = vec_cast<double>(snapshot.cloths[0].at(16, 16));
  EXPECT_GT(std::get<Pull>(wishes.commands[1]).target.y, start.y + 0.05);
  EXPECT_GT(std::get<Pull>(wishes.commands[2]).target.y,
            std::get<Pull>(wishes.commands[1]).target.y);
  EXPECT_TRUE(std::holds_alternative<LetGo>(wishes.commands[3]));
  EXPECT_EQ(camera.camera().eye, eye);
}

TEST_F(Hand, DraggingBesideTheClothOrbits) {
  const Camera before = camera.camera();
  happen(MousePressed{MouseButton::left, {5, 5}});
  happen(MouseMoved{{105, 5}});
  happen(MouseReleased{MouseButton::left, {105, 5}});
  happen(MouseMoved{{300, 300}});
  EXPECT_TRUE(controls.take_wishes().commands.empty());
  EXPECT_GT(length(camera.camera().eye - before.eye), 0.1);
  EXPECT_LT(length(camera.camera().target - before.target), 1e-12);
}

TEST_F(Hand, RightAndMiddlePanAndTheWheelZooms) {
  for (const MouseButton button : {MouseButton::right, MouseButton::middle}) {
    const Camera before = camera.camera();
    happen(MousePressed{button, on_cloth});
    happen(MouseMoved{on_cloth + Vec2d{40, 0}});
    happen(MouseReleased{button, on_cloth + Vec2d{40, 0}});
    EXPECT_GT(length(camera.camera().target - before.target), 0.01);
  }
  const Camera before = camera.camera();
  happen(WheelTurned{1, on_cloth});
  EXPECT_LT(length(camera.camera().eye - camera.camera().target),
            length(before.eye - before.target));
  EXPECT_TRUE(controls.take_wishes().commands.empty());
}

TEST_F(Hand, ThePanelKeepsWhatIsPressedOnIt) {
  const Vec3d eye = camera.camera().eye;
  happen(MousePressed{MouseButton::left, on_cloth}, true);
  happen(MouseMoved{on_cloth + Vec2d{50, 50}}, true);
  happen(WheelTurned{3, on_cloth}, true);
  EXPECT_TRUE(controls.take_wishes().commands.empty());
  EXPECT_EQ(camera.camera().eye, eye);
}

TEST_F(Hand, ASurfaceThatIsNoClothIsOrbited) {
  auto still = std::make_shared<Subject>(*snapshot.subject);
  still->scene.reset();
  snapshot.subject = still;
  const Vec3d eye = camera.camera().eye;
  happen(MousePressed{MouseButton::left, on_cloth});
  happen(MouseMoved{on_cloth + Vec2d{50, 0}});
  EXPECT_TRUE(controls.take_wishes().commands.empty());
  EXPECT_NE(camera.camera().eye, eye);
}

TEST_F(Hand, SpacePausesAndGoesOnAndAPeriodSteps) {
  key(GLFW_KEY_SPACE);
  key(GLFW_KEY_SPACE);
  key(GLFW_KEY_PERIOD);
  EXPECT_FALSE(controls.running());
  key(GLFW_KEY_SPACE);
  const Wishes wishes = controls.take_wishes();
  ASSERT_EQ(wishes.commands.size(), 4U);
  EXPECT_FALSE(std::get<Play>(wishes.commands[0]).running);
  EXPECT_TRUE(std::get<Play>(wishes.commands[1]).running);
  EXPECT_TRUE(std::holds_alternative<StepOnce>(wishes.commands[2]));
  EXPECT_TRUE(std::get<Play>(wishes.commands[3]).running);
}

TEST_F(Hand, KeysAskForWhatTheyAreNamedAfter) {
  key(GLFW_KEY_R);
  key(GLFW_KEY_F);
  key(GLFW_KEY_H);
  key(GLFW_KEY_I);
  key(GLFW_KEY_S);
  key(GLFW_KEY_ESCAPE);
  const Wishes wishes = controls.take_wishes();
  ASSERT_EQ(wishes.commands.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<Reset>(wishes.commands[0]));
  EXPECT_TRUE(wishes.frame && wishes.toggle_panel && wishes.toggle_image && wishes.picture &&
              wishes.close);
  EXPECT_FALSE(wishes.whole_window);
  happen(KeyPressed{GLFW_KEY_S, true});
  const Wishes shifted = controls.take_wishes();
  EXPECT_TRUE(shifted.whole_window && !shifted.picture && !shifted.close);
}

TEST_F(Hand, ColoursTakeTurns) {
  for (std::size_t i = 1; i <= colour_names.size(); ++i) {
    key(GLFW_KEY_C);
    const Wishes wishes = controls.take_wishes();
    ASSERT_EQ(wishes.commands.size(), 1U);
    EXPECT_EQ(static_cast<std::size_t>(std::get<Recolour>(wishes.commands[0]).colouring.by),
              i % colour_names.size());
  }
}

TEST_F(Hand, ADroppedFileOpens) {
  happen(FileDropped{"/there/scene.json"});
  const Wishes wishes = controls.take_wishes();
  ASSERT_EQ(wishes.commands.size(), 1U);
  EXPECT_EQ(std::get<Open>(wishes.commands[0]).subject, "/there/scene.json");
}

}  // namespace
}  // namespace weft::viewer
