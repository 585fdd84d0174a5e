#include "weft/sim/export/cache_manifest.h"

#include <ostream>

#include <nlohmann/json.hpp>

#include "weft/core/files.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

constexpr int manifest_version = 1;

Json surface_json(const SurfaceRecord& record, std::string_view kind) {
  Json json{{"name", record.subject().name},
            {"kind", kind},
            {"moves", record.subject().moves},
            {"files", Json::array()}};
  for (const WrittenFile& file : record.written())
    json["files"].push_back({{"path", file.path.filename().string()},
                             {"format", file.format},
                             {"on", file.on_input ? "input" : "image"},
                             {"vertices", file.vertices}});
  return json;
}

}  // namespace

void write_cache_manifest(const std::filesystem::path& path, const CacheManifest& manifest) {
  Json json{{"version", manifest_version},
            {"unit", manifest.files.unit.name},
            {"metres_per_unit", manifest.files.unit.metres},
            {"up", manifest.files.up()},
            {"frame_rate", manifest.frame_rate},
            {"first_frame", 0},
            {"last_frame", manifest.frames - 1},
            {"frames", manifest.frames},
            {"surfaces", Json::array()}};
  for (const SurfaceRecord* record : manifest.cloths)
    json["surfaces"].push_back(surface_json(*record, "cloth"));
  for (const SurfaceRecord* record : manifest.bodies)
    json["surfaces"].push_back(surface_json(*record, "body"));
  const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace);
  write_file(path, [&](std::ostream& out) { out << text << '\n'; });
}

}  // namespace weft
