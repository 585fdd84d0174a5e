#pragma once

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
