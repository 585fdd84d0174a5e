#pragma once

#include <string>

#include "weft/scene.h"

namespace weft {

struct DrapeOptions {
  bool as_is = false;    ///< keep the body's size
  int cloth_size = 129;  ///< samples a side
  int body_size = 257;
  Material material;
  double friction = 0.4;
  int frames = 120;
  MeshFrame files;  ///< unit and up axis of mesh files
};

/// A scene in which a cloth falls onto a body. The body is scaled so that its largest side is 1 m
/// and stands on the ground. A sheet or disk is scaled to 1.6 times the body's wider horizontal
/// side; every other cloth keeps its size. The cloth is laid 2 cm above the body's top. But where
/// the boxes of cloth and body overlap by more than half of the cloth's, and less than a quarter of
/// it is inside of the closed body (a garment already on its body), both keep position and scale,
/// and the ground is laid under the body. Built-in shapes that are images by nature are no
/// garments: they are always laid on top.
/// @param cloth, body  meshes, geometry images or builtin:NAME
/// @throws InputError, UsageError when they cannot be read
Scene make_drape_scene(const std::string& cloth, const std::string& body,
                       const DrapeOptions& options);

}  // namespace weft
