#pragma once

#include <string>

#include "tests/support/errors.h"
#include "weft/simulation.h"

namespace weft::test {

/// What a simulation of a scene is refused with; empty where it begins.
inline std::string refusal_of(const Scene& scene) {
  return message_of<SceneError>([&] { Simulation(scene, "s.json", 1); });
}

}  // namespace weft::test
