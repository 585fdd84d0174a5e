#pragma once

#include "weft/scene.h"

namespace weft::testing {

/// A flat square sheet of 1 m. @param size  samples a side @param translate  [m]
inline SceneCloth sheet(int size, Vec3d translate) {
  SceneCloth cloth;
  cloth.size = size;
  cloth.placement.translate = translate;
  return cloth;
}

/// A sheet of 17 x 17 samples at 2 m that flies, with no ground below.
inline Scene free_fall(const IntegratorOptions& integrator) {
  Scene scene;
  scene.ground.reset();
  scene.integrator = integrator;
  scene.cloths = {sheet(17, {0, 2, 0})};
  scene.cloths[0].velocity = {0.5, 1, 0};
  return scene;
}

}  // namespace weft::testing
