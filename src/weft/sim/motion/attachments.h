#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/mesh.h"
#include "weft/scene.h"
#include "weft/sim/motion/pins.h"

namespace weft {

/// A surface that cloth is tied to, at the start of the run.
struct TiedSurface {
  std::string name;
  const Planes3* positions = nullptr;  ///< [n x n] world [m]
  std::vector<Triangle> triangles;     ///< corners as samples
};

/// A place fixed relative to the triangle of a body that is nearest at the start: at an offset from
/// the closest point, in axes that rotate with the triangle.
struct TiedPlace {
  int body = 0;         ///< of the scene
  Triangle triangle{};  ///< samples of the body
  std::array<double, 3> weights{};
  Vec3d offset;  ///< from the closest point, in the triangle's axes [m]
};

/// A pin in such a place.
struct TiedPin : TiedPlace {
  int pin = 0;  ///< of the cloth
};

/// Ties places to the nearest of several bodies each; none where no body has any area.
/// @param bodies  the scene's, in its order
std::vector<std::optional<TiedPlace>> tie_to_nearest(std::span<const Vec3d> places,
                                                     std::span<const TiedSurface> bodies);
/// Where a tied place is. @param body  positions of its body [n x n] world [m]
Vec3d tied_place(const TiedPlace& tied, const Planes3& body);

/// Pins the places of a cloth's `attach` list, and removes them from `motions`. A sample named
/// twice is tied by the last.
/// @param bodies   the scene's, in its order
/// @throws SceneError when a region holds no sample, no body has the name, or it has no area
std::vector<TiedPin> tie_places(Cloth& cloth, std::span<const SceneAttachment> places,
                                std::span<const TiedSurface> bodies,
                                std::vector<PinMotion>& motions);

/// Sets the targets of tied pins.
/// @param bodies  positions of each body [n x n] world [m]; null where it does not move
void move_tied(std::span<const TiedPin> tied, std::span<const Planes3* const> bodies, Cloth& cloth);

}  // namespace weft
