#include "weft/view/gl/lights.h"

#include <cmath>

#include "weft/core/math.h"

namespace weft::gl {
namespace {

Vec3d direction_of(double azimuth, double elevation) {
  return {sine(azimuth) * cosine(elevation), sine(elevation), cosine(azimuth) * cosine(elevation)};
}

/// Evenly spread directions over the upper hemisphere but for a band at the horizon: a golden-angle
/// spiral.
Vec3d sky_direction(int i) {
  constexpr double lowest = 0.06;
  const double y = lowest + (1 - lowest) * (i + 0.5) / sky_sides;
  const double side = std::sqrt(1 - y * y);
  const double angle = i * (3 - std::sqrt(5.0)) * pi;
  return {side * cosine(angle), y, side * sine(angle)};
}

/// Brighter above, with a wide bright patch opposite to the key light that fills its shadows.
Vec3f sky_shine(Vec3d direction, Vec3d key) {
  const Vec3d fill = normalized(Vec3d{-key.x, 0.6, -key.z});
  const double patch = std::fmax(0.0, dot(direction, fill));
  const double above = 0.55 + 0.45 * direction.y;
  return static_cast<float>(above + 1.1 * patch * patch) * sky_strength;
}

}  // namespace

Lights make_lights(const KeyLight& key, const Box3d& box) {
  Lights lights;
  const double diagonal = box.empty() ? 0 : box.diagonal();
  const bool usable = std::isfinite(diagonal) && diagonal > 0;
  lights.centre = usable ? box.centre() : Vec3d{};
  lights.radius = usable ? 0.5 * diagonal * 1.02 : 1;
  const Vec3d towards = direction_of(key.azimuth, key.elevation);
  lights.key = frame_towards(towards, {0, 1, 0});
  float open = 0;
  for (int i = 0; i < sky_sides; ++i) {
    const Vec3d direction = sky_direction(i);
    lights.sky[i] = frame_towards(direction, {0, 1, 0});
    lights.sky_direction[i] = vec_cast<float>(direction);
    lights.sky_colour[i] = sky_shine(direction, towards);
    open += lights.sky_direction[i].y * lights.sky_colour[i].y;
  }
  for (Vec3f& colour : lights.sky_colour) colour = (sky_strength.y / open) * colour;
  return lights;
}

}  // namespace weft::gl
