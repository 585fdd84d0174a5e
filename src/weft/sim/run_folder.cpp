#include "weft/sim/run_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <ostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/error.h"
#include "weft/core/files.h"
#include "weft/image/io/exr_codec.h"
#include "weft/image/io/image_file.h"
#include "weft/sim/detail/json_object.h"
#include "weft/sim/export/surface_points.h"
#include "weft/sim/placement.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* manifest_name = "weft-run.json";
constexpr int manifest_version = 1;
constexpr std::streamoff pc2_header_bytes = 32;

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

constexpr std::array<std::string_view, 8> manifest_keys{"version", "scene",  "unit",   "frame_rate",
                                                        "frames",  "ground", "cloths", "bodies"};
constexpr std::array<std::string_view, 4> cloth_keys{"name", "image", "cache", "unwelded"};
constexpr std::array<std::string_view, 8> body_keys{"name",   "image",     "normals", "scale",
                                                    "rotate", "translate", "cache",   "unwelded"};

/// Points and frames that a PC2 file says it holds, checked against its length.
void read_cache_header(RecordedPoints& recorded) {
  const std::string where = recorded.cache.string();
  std::ifstream in(recorded.cache, std::ios::binary);
  std::array<char, pc2_header_bytes> header{};
  if (!in || !in.read(header.data(), header.size()) ||
      std::string_view(header.data(), 11) != "POINTCACHE2")
    throw InputError(where, "no point cache", "a PC2 file is wanted");
  std::int32_t points = 0, frames = 0;
  std::memcpy(&points, header.data() + 16, 4);
  std::memcpy(&frames, header.data() + 28, 4);
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(recorded.cache, error);
  const auto wanted = static_cast<std::uintmax_t>(pc2_header_bytes) +
                      12 * static_cast<std::uintmax_t>(std::max(points, 0)) * std::max(frames, 0);
  if (points < 1 || frames < 0 || error || bytes != wanted)
    throw InputError(where,
                     fmt::format("{} bytes for {} points and {} frames", bytes, points, frames),
                     fmt::format("{} bytes are wanted", wanted));
  recorded.points = points;
  recorded.frames = frames;
}

/// @param object  of a cloth or body that names its cache
RecordedPoints open_cache(const fs::path& folder, const JsonObject& object,
                          const GeometryImage& image) {
  RecordedPoints recorded;
  const std::string cache = object.text("cache", "");
  if (cache.empty())
    object.place().key("cache").fail("no cache", "a run that exports pc2 is wanted");
  recorded.cache = folder / cache;
  SurfacePoints points = surface_points(image, object.boolean("unwelded", false));
  recorded.vertex_of = std::move(points.vertex_of);
  read_cache_header(recorded);
  if (recorded.points != static_cast<int>(points.sample_of.size()))
    throw InputError(recorded.cache.string(), fmt::format("{} points", recorded.points),
                     fmt::format("the image makes {}", points.sample_of.size()));
  return recorded;
}

RecordedCloth open_cloth(const fs::path& folder, const Json& value, const JsonPlace& place) {
  const JsonObject object(value, place, cloth_keys);
  RecordedCloth cloth;
  cloth.name = object.text("name", "");
  cloth.image = read_image(folder / object.text("image", ""));
  cloth.recorded = open_cache(folder, object, cloth.image);
  return cloth;
}

RecordedBody open_body(const fs::path& folder, const Json& value, const JsonPlace& place) {
  const JsonObject object(value, place, body_keys);
  RecordedBody body;
  body.name = object.text("name", "");
  body.image = read_image(folder / object.text("image", ""));
  const PlacementMap map = placement_map(placement_of(object));
  body.positions = placed_positions(body.image, map);
  if (object.has("cache")) {
    body.recorded = open_cache(folder, object, body.image);
    return body;
  }
  const std::string normals = object.text("normals", "");
  if (!normals.empty()) {
    const fs::path path = folder / normals;
    body.normals =
        placed_normals(NormalMap{decode_exr(read_file(path), path.string()).planes}, map);
  }
  return body;
}

Json parse_manifest(const fs::path& path) {
  const std::string text = read_file(path);
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    throw InputError(path.string(), "is not JSON", "the record of a run is wanted");
  return json;
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
  const auto each = [&](std::string_view key, const auto& add) {
    const Json* list = root.find(key);
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i)
      add((*list)[i], place.key(key).element(i));
  };
  each("cloths", [&](const Json& value, const JsonPlace& at) {
    run.cloths.push_back(open_cloth(folder, value, at));
  });
  each("bodies", [&](const Json& value, const JsonPlace& at) {
    run.bodies.push_back(open_body(folder, value, at));
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
  std::vector<Vec3f> read(static_cast<std::size_t>(points));
  const auto bytes = static_cast<std::streamoff>(read.size() * sizeof(Vec3f));
  std::ifstream in(cache, std::ios::binary);
  in.seekg(pc2_header_bytes + frame * bytes);
  if (!in.read(reinterpret_cast<char*>(read.data()), bytes))
    throw InputError(cache.string(), "ends early", "a whole point cache is wanted");
  const auto side = static_cast<int>(std::lround(std::sqrt(vertex_of.size())));
  Planes3 positions(side);
  for (std::size_t s = 0; s < vertex_of.size(); ++s)
    positions.set(static_cast<int>(s), read[static_cast<std::size_t>(vertex_of[s])]);
  return positions;
}

RunFolder open_run_folder(const fs::path& folder) {
  const fs::path path = folder / manifest_name;
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    throw InputError(folder.string(), fmt::format("holds no {}", manifest_name),
                     "the folder of a run is wanted");
  try {
    return read_manifest(folder, parse_manifest(path), {path.string(), ""});
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path.string(), error.what(), "the record of a run is wanted");
  }
}

void write_run_manifest(const fs::path& path, const Scene& scene, const RunReport& report,
                        const RunOptions& options) {
  const bool cached =
      std::find(options.exports.begin(), options.exports.end(), "pc2") != options.exports.end();
  Json json{{"version", manifest_version},
            {"scene", report.scene},
            {"unit", "m"},
            {"frame_rate", scene.frame_rate},
            {"frames", report.centre_of_mass.size()},
            {"ground", scene.ground ? Json(*scene.ground) : Json()},
            {"cloths", Json::array()},
            {"bodies", Json::array()}};
  for (const SceneCloth& cloth : scene.cloths)
    json["cloths"].push_back({{"name", cloth.name},
                              {"image", cloth.name + ".exr"},
                              {"cache", cached ? cloth.name + ".pc2" : ""},
                              {"unwelded", options.unwelded}});
  for (const SceneBody& body : scene.bodies) {
    Json placed = placed_json(body.name, body.placement);
    const fs::path normals = normals_path(options.folder, body.name);
    if (fs::exists(normals)) placed["normals"] = normals.filename().string();
    if (!body.motion.empty() || !body.animation.empty()) {
      placed["cache"] = cached ? body.name + ".pc2" : "";
      placed["unwelded"] = options.unwelded;
    }
    json["bodies"].push_back(std::move(placed));
  }
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
  write_file(path, [&](std::ostream& out) { out << text << '\n'; });
}

fs::path normals_path(const fs::path& folder, const std::string& body) {
  return folder / (body + ".normals.exr");
}

}  // namespace weft
