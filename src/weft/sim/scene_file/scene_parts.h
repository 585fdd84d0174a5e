#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "weft/scene.h"
#include "weft/sim/scene_file/json_object.h"

namespace weft {

// Readers of the parts of a scene file. All throw SceneError with FILE:KEY.

IntegratorOptions read_integrator(const nlohmann::json& value, const JsonPlace& place,
                                  std::optional<int>& limiter_passes);
ColliderOptions read_collider(const nlohmann::json& value, const JsonPlace& place);
/// Reads the keys "unit" and "up" of an object.
MeshFrame read_frame(const JsonObject& object);
Material read_material(const nlohmann::json& value, const JsonPlace& place);
/// Keys at ascending times; empty where the object has none.
std::vector<MotionKey> read_motion(const JsonObject& object, std::string_view key);
std::vector<ScenePin> read_pins(const JsonObject& object);
std::vector<SceneAttachment> read_attachments(const JsonObject& object);
/// @param folder  where relative surfaces are looked for
SceneCloth read_cloth(const nlohmann::json& value, const JsonPlace& place,
                      const std::filesystem::path& folder);
SceneBody read_body(const nlohmann::json& value, const JsonPlace& place,
                    const std::filesystem::path& folder);

}  // namespace weft

// What each object of a scene file may hold. `docs/scene.schema.json` lists the same (a test
// compares).

namespace weft::scene_keys {

inline constexpr std::array<std::string_view, 14> scene{
    "version",     "gravity",    "frame_rate", "substeps", "frames", "ground", "wind",
    "air_damping", "integrator", "collider",   "unit",     "up",     "cloths", "bodies"};
inline constexpr std::array<std::string_view, 3> wind{"velocity", "drag", "lift"};
inline constexpr std::string_view limiter_passes = "limiter_passes";
/// Keys of an integrator or a collider, see weft/methods.h.
template <class Options>
std::vector<std::string_view> of_method() {
  std::vector<std::string_view> keys{"type"};
  if constexpr (requires { Options::traits.has_limiter; })
    if (Options::traits.has_limiter) keys.push_back(limiter_passes);
  Options::visit_options(
      [&](std::string_view key, auto /*member*/, const auto& /*range*/) { keys.push_back(key); });
  return keys;
}
inline constexpr std::array<std::string_view, 16> cloth{
    "name",     "surface",  "size",   "sew",       "layer",    "rest",
    "uv_scale", "scale",    "rotate", "translate", "material", "self_collision",
    "friction", "velocity", "pins",   "attach"};
inline constexpr std::array<std::string_view, 1> sew{"spacing"};
inline constexpr std::array<std::string_view, 11> body{
    "name",     "surface", "size",      "scale", "rotate", "translate",
    "friction", "motion",  "animation", "wait",  "lead_in"};
inline constexpr std::array<std::string_view, 8> material{"density",      "stretch",      "shear",
                                                          "bending",      "bend_springs", "damping",
                                                          "strain_limit", "thickness"};
inline constexpr std::array<std::string_view, 3> motion_key{"time", "rotate", "translate"};
inline constexpr std::array<std::string_view, 4> pin{"image", "nearest", "region", "path"};
inline constexpr std::array<std::string_view, 4> attachment{"body", "image", "nearest", "region"};

}  // namespace weft::scene_keys
