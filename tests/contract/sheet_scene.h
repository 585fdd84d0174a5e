#pragma once

#include <string>
#include <utility>

#include "weft/scene.h"
#include "weft/simulation.h"

namespace weft::test {

/// A sheet of a metre, 0.55 m up, over one body.
inline Scene sheet_over(SceneBody body) {
  SceneCloth sheet;
  sheet.size = 33;
  sheet.placement.translate = {0, 0.55, 0};
  Scene scene;
  scene.cloths = {sheet};
  scene.bodies = {std::move(body)};
  return scene;
}

/// Of the state after so many frames.
inline std::string hash_of(const Scene& scene, int frames = 12) {
  Simulation simulation(scene, "memory", 1);
  for (int frame = 0; frame < frames; ++frame) simulation.advance();
  return simulation.state_hash();
}

}  // namespace weft::test
