// The schema of scene files against what reads them.
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"
#include "weft/core/json.h"
#include "weft/fabric.h"
#include "weft/files.h"
#include "weft/scene_file.h"
#include "weft/sim/scene_file/scene_parts.h"

namespace weft {
namespace {

/// All keys below "properties" of a schema node, its alternatives included.
std::set<std::string> properties_of(const nlohmann::json& node) {
  std::set<std::string> keys;
  if (node.contains("properties"))
    for (const auto& [key, ignored] : node["properties"].items()) keys.insert(key);
  for (const char* list : {"oneOf", "anyOf"})
    if (node.contains(list))
      for (const auto& one : node[list]) keys.merge(properties_of(one));
  return keys;
}

template <class Keys>
std::set<std::string> as_set(const Keys& keys) {
  return {keys.begin(), keys.end()};
}

TEST(SceneSchema, ListsTheKeysThatTheReaderKnows) {
  const nlohmann::json schema =
      parse_json(read_file(std::string(WEFT_SOURCE_DIR) + "/docs/scene.schema.json"), 32);
  const auto& parts = schema["$defs"];
  EXPECT_EQ(properties_of(schema), as_set(scene_keys::scene));
  EXPECT_EQ(properties_of(parts["wind"]), as_set(scene_keys::wind));
  EXPECT_EQ(properties_of(parts["newton"]), as_set(scene_keys::of_method<NewtonOptions>()));
  EXPECT_EQ(properties_of(parts["implicit"]), as_set(scene_keys::of_method<ImplicitOptions>()));
  EXPECT_EQ(properties_of(parts["explicit"]), as_set(scene_keys::of_method<ExplicitOptions>()));
  EXPECT_EQ(properties_of(parts["desbrun"]), as_set(scene_keys::of_method<DesbrunOptions>()));
  EXPECT_EQ(properties_of(parts["multigrid"]), as_set(scene_keys::of_method<MultigridOptions>()));
  EXPECT_EQ(properties_of(parts["two_level"]), as_set(scene_keys::of_method<TwoLevelOptions>()));
  for (const char* type : {"pyramid", "sphere_tree", "spatial_hash", "image_space"})
    EXPECT_EQ(properties_of(parts[type]), as_set(scene_keys::of_method<PyramidOptions>()));
  EXPECT_EQ(properties_of(parts["polar_map"]), as_set(scene_keys::of_method<PolarMapOptions>()));
  EXPECT_EQ(properties_of(parts["cloth"]), as_set(scene_keys::cloth));
  EXPECT_EQ(properties_of(parts["sew"]), as_set(scene_keys::sew));
  EXPECT_EQ(properties_of(parts["body"]), as_set(scene_keys::body));
  EXPECT_EQ(properties_of(parts["material"]), as_set(scene_keys::material));
  EXPECT_EQ(properties_of(parts["pin"]), as_set(scene_keys::pin));
  EXPECT_EQ(properties_of(parts["attachment"]), as_set(scene_keys::attachment));
  EXPECT_EQ(properties_of(parts["motion_key"]), as_set(scene_keys::motion_key));
}

TEST(SceneSchema, DefaultsAreTheReadersDefaults) {
  const nlohmann::json schema =
      parse_json(read_file(std::string(WEFT_SOURCE_DIR) + "/docs/scene.schema.json"), 32);
  Scene scene;
  scene.cloths.emplace_back();
  const test::TemporaryFolder folder;
  const std::string path = (folder / "defaults.json").string();
  write_scene(path, scene);
  const nlohmann::json json = parse_json(read_file(path), 32);
  const auto check = [](const nlohmann::json& properties, const nlohmann::json& values) {
    for (const auto& [key, property] : properties.items()) {
      if (!property.contains("default") || !values.contains(key)) continue;
      const auto& value = values[key];
      // A scale may be one number for three.
      const bool same = property["default"] == value ||
                        (key == "scale" && value == nlohmann::json{1.0, 1.0, 1.0});
      EXPECT_TRUE(same) << key << ": " << property["default"] << " against " << value;
    }
  };
  check(schema["properties"], json);
  check(schema["$defs"]["cloth"]["properties"], json["cloths"][0]);
  check(schema["$defs"]["material"]["properties"], json["cloths"][0]["material"]);
  EXPECT_EQ(json["integrator"]["type"], schema["$defs"]["newton"]["properties"]["type"]["const"]);
  for (const IntegratorOptions& integrator :
       {IntegratorOptions{NewtonOptions{}}, IntegratorOptions{MultigridOptions{}},
        IntegratorOptions{ImplicitOptions{}}, IntegratorOptions{TwoLevelOptions{}}}) {
    scene.integrator = integrator;
    const nlohmann::json written = parse_json(scene_text(scene, path), 32);
    check(schema["$defs"][std::string(name_of(integrator))]["properties"], written["integrator"]);
  }
  EXPECT_EQ(json["collider"]["type"], schema["$defs"]["pyramid"]["properties"]["type"]["const"]);
  scene.collider = PolarMapOptions{};
  const nlohmann::json polar_map = parse_json(scene_text(scene, path), 32);
  check(schema["$defs"]["polar_map"]["properties"], polar_map["collider"]);
}

}  // namespace
}  // namespace weft
