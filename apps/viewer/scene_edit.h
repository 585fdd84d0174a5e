#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/scene.h"

namespace weft::viewer {

// Changes of a scene that the panel offers.

std::vector<std::string_view> integrator_names();
std::vector<std::string_view> collider_names();
/// Sets an integrator, or a collider, with default options. @pre one of the names
void set_integrator(Scene& scene, std::string_view name);
void set_collider(Scene& scene, std::string_view name);

/// The name of the first cloth's material; empty where it is one of the scene's own.
std::string_view material_name(const Scene& scene);
/// Sets the material of every cloth. @pre one of named_materials
void set_material(Scene& scene, std::string_view name);

void set_wind(Scene& scene, Vec3d velocity);
/// Sets the friction of every cloth and every body.
void set_friction(Scene& scene, double friction);
/// Bodies that may be chosen, `builtin:` before each.
std::vector<std::string> builtin_bodies();
/// Removes bodies and the attachments to them.
void remove_bodies(Scene& scene);

}  // namespace weft::viewer
