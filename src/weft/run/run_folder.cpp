#include "weft/run_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/cloth/measure.h"
#include "weft/cloth/rest_shape.h"
#include "weft/core/json.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/image/io/exr_codec.h"
#include "weft/image/io/metadata.h"
#include "weft/image_file.h"
#include "weft/run/export/surface_points.h"
#include "weft/run/run_manifest.h"
#include "weft/sim/placement.h"
#include "weft/sim/scene_file/scene_parts.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* manifest_name = "weft-run.json";
constexpr int manifest_version = 1, deepest_manifest = 16;

Json vector_json(Vec3d v) { return {v.x, v.y, v.z}; }

Json placed_json(const std::string& name, const Placement& placement) {
  return {{"name", name},
          {"image", name + ".exr"},
          {"scale", vector_json(placement.scale)},
          {"rotate", vector_json(placement.rotate)},
          {"translate", vector_json(placement.translate)}};
}

Placement placement_of(const JsonObject& object) {
  return {object.vector("scale", {1, 1, 1}), object.vector("rotate", {}),
          object.vector("translate", {})};
}

/// The metadata of rest shapes in folders of versions that did not tell what is sewn.
constexpr const char* rest_without_seams = "rest";

constexpr std::array<std::string_view, 9> manifest_keys{
    "version", "scene", "unit", "up", "frame_rate", "frames", "ground", "cloths", "bodies"};
constexpr std::array<std::string_view, 5> cloth_keys{"name", "image", "rest", "cache", "unwelded"};
constexpr std::array<std::string_view, 8> body_keys{"name",   "image",     "normals", "scale",
                                                    "rotate", "translate", "cache",   "unwelded"};

/// Folder of the files of a run, and their unit and axes.
struct RecordedPlace {
  fs::path folder;
  MeshFrame files;
};

/// @param object  of a cloth or body that names its cache
RecordedPoints open_cache(const RecordedPlace& place, const JsonObject& object,
                          const GeometryImage& image) {
  RecordedPoints recorded;
  recorded.files = place.files;
  const std::string cache = object.text("cache", "");
  if (cache.empty())
    object.place().key("cache").fail("no cache", "a run that exports pc2 is wanted");
  recorded.cache = place.folder / cache;
  SurfacePoints points = surface_points(image, object.boolean("unwelded", false));
  recorded.vertex_of = std::move(points.vertex_of);
  const PointFrames frames(recorded.cache);
  recorded.points = frames.points();
  recorded.frames = frames.frames();
  if (recorded.points != static_cast<int>(points.sample_of.size()))
    throw InputError(recorded.cache.string(), fmt::format("{} points", recorded.points),
                     fmt::format("the image makes {}", points.sample_of.size()));
  return recorded;
}

/// Reads the rest shape, if the folder tells it, and the seams that are sewn, if it does.
void read_rest(const RecordedPlace& from, const JsonObject& object, RecordedCloth& cloth) {
  const int n = cloth.image.size();
  cloth.mates = cloth.image.mates;
  const std::string rest = object.text("rest", "");
  const bool is_image = rest == object.text("image", "");
  if (is_image) cloth.rest = world_positions(cloth.image);
  if (rest.empty() || is_image) return;
  const fs::path path = from.folder / rest;
  DecodedImage decoded = decode_exr(read_file(path), path.string());
  if (decoded.planes.size() != n)
    throw InputError(path.string(), fmt::format("{} samples a side", decoded.planes.size()),
                     fmt::format("the image has {}", n));
  cloth.rest = std::move(decoded.planes);
  if (decoded.text != rest_without_seams) cloth.mates = mates_in(decoded.text, n, path.string());
}

RecordedCloth open_cloth(const RecordedPlace& from, const Json& value, const JsonPlace& place) {
  const JsonObject object(value, place, cloth_keys);
  RecordedCloth cloth;
  cloth.name = object.text("name", "");
  cloth.image = read_image(from.folder / object.text("image", ""));
  cloth.recorded = open_cache(from, object, cloth.image);
  read_rest(from, object, cloth);
  return cloth;
}

RecordedBody open_body(const RecordedPlace& from, const Json& value, const JsonPlace& place) {
  const JsonObject object(value, place, body_keys);
  RecordedBody body;
  body.name = object.text("name", "");
  body.image = read_image(from.folder / object.text("image", ""));
  const PlacementMap map = placement_map(placement_of(object));
  body.positions = placed_positions(body.image, map);
  if (object.has("cache")) body.recorded = open_cache(from, object, body.image);
  const std::string normals = object.text("normals", "");
  if (!normals.empty()) {
    const fs::path path = from.folder / normals;
    body.normals =
        placed_normals(NormalMap{decode_exr(read_file(path), path.string()).planes}, map);
  }
  return body;
}

Json parse_manifest(const fs::path& path) {
  const std::string text = read_file(path);
  try {
    return parse_json(text, deepest_manifest);
  } catch (const JsonFault& fault) {
    throw InputError(fault.place(path.string()), fault.what(), "the record of a run is wanted");
  }
}

RunFolder read_manifest(const fs::path& folder, const Json& json, const JsonPlace& place) {
  const JsonObject root(json, place, manifest_keys);
  if (root.integer("version", 0, 0, 1'000'000) != manifest_version)
    place.key("version").fail("unknown version", fmt::format("{} is wanted", manifest_version));
  RunFolder run;
  run.scene = root.text("scene", "");
  run.frame_rate = root.number("frame_rate", 60, positive);
  run.frames = root.integer("frames", 0, 0, 100'000'000);
  const Json* ground = root.find("ground");
  if (ground != nullptr && !ground->is_null()) run.ground = root.number("ground", 0);
  const RecordedPlace from{folder, read_frame(root)};
  const auto each = [&](std::string_view key, const auto& add) {
    const Json* list = root.find(key);
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
      add((*list)[i], place.key(key).element(i));
  };
  each("cloths", [&](const Json& value, const JsonPlace& at) {
    run.cloths.push_back(open_cloth(from, value, at));
  });
  each("bodies", [&](const Json& value, const JsonPlace& at) {
    run.bodies.push_back(open_body(from, value, at));
  });
  for (const RecordedCloth& cloth : run.cloths)
    run.frames = std::min(run.frames, cloth.recorded.frames);
  for (const RecordedBody& body : run.bodies)
    if (body.recorded) run.frames = std::min(run.frames, body.recorded->frames);
  return run;
}

}  // namespace

Planes3 RecordedPoints::positions(int frame) const {
  if (frame < 0 || frame >= frames)
    throw UsageError(cache.string(), fmt::format("no frame {}", frame),
                     fmt::format("frames 0 to {} are there", frames - 1));
  PointFrames all(cache);
  if (frame >= all.frames() || all.points() != points)
    throw InputError(cache.string(), "ends early", "a whole point cache is wanted");
  const std::vector<Vec3f> read = all.read(frame);
  const auto side = static_cast<int>(std::lround(std::sqrt(vertex_of.size())));
  Planes3 positions(side);
  for (std::size_t s = 0; s < vertex_of.size(); ++s)
    positions.set(static_cast<int>(s),
                  vec_cast<float>(in_metres_y_up(
                      vec_cast<double>(read[static_cast<std::size_t>(vertex_of[s])]), files)));
  return positions;
}

struct RecordedStrain::Springs {
  std::array<SpringPlane, 2> stretch;
};

RecordedStrain::RecordedStrain(const RecordedCloth& cloth) {
  const RestShape shape(cloth.rest, cloth.mates);
  springs_ = std::make_unique<Springs>(Springs{
      {make_springs(shape, Material{}, stretch_u), make_springs(shape, Material{}, stretch_v)}});
}

RecordedStrain::RecordedStrain(RecordedStrain&&) noexcept = default;
RecordedStrain::~RecordedStrain() = default;

Grid<float> RecordedStrain::at_samples(const Planes3& positions) const {
  Grid<float> strains(positions.size(), positions.size());
  strain_at_samples(springs_->stretch, positions, strains);
  return strains;
}

RunFolder open_run_folder(const fs::path& folder) {
  const fs::path path = folder / manifest_name;
  std::error_code closed;
  const bool there = fs::exists(path, closed);
  if (closed)
    throw InputError(folder.string(), "cannot be looked into: " + closed.message(),
                     "a readable folder is wanted");
  if (!there)
    throw InputError(folder.string(), fmt::format("holds no {}", manifest_name),
                     "the folder of a run is wanted");
  try {
    return read_manifest(folder, parse_manifest(path), {path.string(), ""});
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path.string(), error.what(), "the record of a run is wanted");
  }
}

void write_run_manifest(const fs::path& path, const Scene& scene, const RunReport& report,
                        const RunCaches& caches) {
  Json json{{"version", manifest_version},
            {"scene", report.scene},
            {"unit", scene.files.unit.name},
            {"up", scene.files.up()},
            {"frame_rate", scene.frame_rate},
            {"frames", report.centre_of_mass.size()},
            {"ground", scene.ground ? Json(*scene.ground) : Json()},
            {"cloths", Json::array()},
            {"bodies", Json::array()}};
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const SceneCloth& cloth = scene.cloths[i];
    const std::string image = cloth.name + ".exr";
    const fs::path rest = rest_path(caches.folder, cloth.name);
    std::error_code ignored;
    json["cloths"].push_back(
        {{"name", cloth.name},
         {"image", image},
         {"rest", fs::exists(rest, ignored) ? rest.filename().string() : image},
         {"cache", caches.cloths[i]},
         {"unwelded", caches.unwelded}});
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    Json placed = placed_json(body.name, body.placement);
    const fs::path normals = normals_path(caches.folder, body.name);
    std::error_code ignored;
    if (fs::exists(normals, ignored)) placed["normals"] = normals.filename().string();
    if (!body.motion.empty() || !body.animation.empty()) {
      placed["cache"] = caches.bodies[i];
      placed["unwelded"] = caches.unwelded;
    }
    json["bodies"].push_back(std::move(placed));
  }
  const std::string text = json_text(json, 2);
  write_file(path, [&](std::ostream& out) { out << text << '\n'; });
}

fs::path rest_path(const fs::path& folder, const std::string& cloth) {
  return folder / (cloth + ".rest.exr");
}

fs::path normals_path(const fs::path& folder, const std::string& body) {
  return folder / (body + ".normals.exr");
}

}  // namespace weft
