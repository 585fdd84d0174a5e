#include "weft/state_bytes.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/errors.h"
#include "weft/error.h"
#include "weft/scene.h"

namespace weft {
namespace {

/// A sheet that slides over a ball with one corner held: contacts, friction and a pin.
Scene held_over_a_ball() {
  Scene scene;
  SceneCloth sheet;
  sheet.size = 17;
  sheet.placement.translate = {0, 0.6, 0};
  sheet.pins = {ImagePin{{0, 0}}};
  SceneBody ball;
  ball.surface = {"builtin:sphere"};
  ball.size = 17;
  scene.cloths = {sheet};
  scene.bodies = {ball};
  return scene;
}

SimulationState after(Simulation& simulation, int frames) {
  for (int i = 0; i < frames; ++i) simulation.advance();
  SimulationState state;
  simulation.save(state);
  return state;
}

std::string refusal_of_state(const std::string& bytes) {
  return test::message_of<InputError>([&] { (void)decode_state(bytes, "there"); });
}

TEST(StateBytes, AnotherSimulationGoesOnWithTheSameBits) {
  const Scene scene = held_over_a_ball();
  Simulation first(scene, "first", 1), second(scene, "second", 1);
  const std::string bytes = encode_state(after(first, 20));
  second.restore(decode_state(bytes, "there"));
  EXPECT_EQ(second.frame(), 20);
  EXPECT_GT(second.advance().contacts, 0);
  first.advance();
  EXPECT_EQ(second.state_hash(), first.state_hash());
  EXPECT_EQ(encode_state(after(second, 3)), encode_state(after(first, 3)));
}

TEST(StateBytes, WhatIsReadIsWrittenAsItWas) {
  Simulation simulation(held_over_a_ball(), "scene", 1);
  const SimulationState state = after(simulation, 20);
  ASSERT_EQ(state.pin_targets.size(), 1);
  ASSERT_EQ(state.pin_targets[0].size(), 1);
  ASSERT_FALSE(state.contacts[0].empty());
  const std::string bytes = encode_state(state);
  EXPECT_EQ(encode_state(decode_state(bytes, "there")), bytes);
}

TEST(StateBytes, DamageIsRefusedInOneLine) {
  Simulation simulation(held_over_a_ball(), "scene", 1);
  const std::string whole = encode_state(after(simulation, 1));
  for (std::size_t at = 0; at < whole.size(); at += at < 40 ? 1 : 97) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    ASSERT_EQ(refusal_of_state(damaged).rfind("there: ", 0), 0) << at;
    ASSERT_EQ(refusal_of_state(whole.substr(0, at)).rfind("there: ", 0), 0) << at;
  }
  EXPECT_NE(refusal_of_state("WEFTCKPT").find("is no state of a simulation"), std::string::npos);
}

}  // namespace
}  // namespace weft
