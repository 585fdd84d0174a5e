#include "apps/viewer/scene_edit.h"

#include <algorithm>
#include <array>

#include "weft/fabric.h"

namespace weft::viewer {
namespace {

constexpr std::array<std::string_view, 8> bodies{"mannequin", "sphere", "torus", "cone",
                                                 "box",       "knot",   "rod",   "double_torus"};

bool are_same(const Material& a, const Material& b) {
  return a.density == b.density && a.stretch == b.stretch && a.shear == b.shear &&
         a.bending == b.bending && a.bend_springs == b.bend_springs && a.damping == b.damping &&
         a.strain_limit == b.strain_limit && a.thickness == b.thickness;
}

}  // namespace

std::vector<std::string_view> integrator_names() { return Integrators::names(); }
std::vector<std::string_view> collider_names() { return Colliders::names(); }

void set_integrator(Scene& scene, std::string_view name) {
  if (const auto found = Integrators::find(name)) scene.integrator = *found;
}

void set_collider(Scene& scene, std::string_view name) {
  if (const auto collider = Colliders::find(name)) scene.collider = *collider;
  // The new collider may not support the self-collision that was set for another one.
  if (!Colliders::traits_of(scene.collider).self_collision)
    for (SceneCloth& cloth : scene.cloths) cloth.self_collision.reset();
}

std::string_view material_name(const Scene& scene) {
  for (const NamedMaterial& named : named_materials())
    if (!scene.cloths.empty() && are_same(named.material, scene.cloths[0].material))
      return named.name;
  return {};
}

void set_material(Scene& scene, std::string_view name) {
  const auto material = find_material(name);
  if (!material) return;
  for (SceneCloth& cloth : scene.cloths) cloth.material = *material;
}

void set_wind(Scene& scene, Vec3d velocity) {
  if (!scene.wind) scene.wind.emplace();
  scene.wind->velocity = velocity;
}

void set_friction(Scene& scene, double friction) {
  for (SceneCloth& cloth : scene.cloths) cloth.friction = friction;
  for (SceneBody& body : scene.bodies) body.friction = friction;
}

std::vector<std::string> builtin_bodies() {
  std::vector<std::string> names;
  names.reserve(std::size(bodies));
  for (const std::string_view body : bodies) names.push_back("builtin:" + std::string(body));
  return names;
}

void remove_bodies(Scene& scene) {
  scene.bodies.clear();
  for (SceneCloth& cloth : scene.cloths) cloth.attach.clear();
}

}  // namespace weft::viewer
