#include "weft/run/export/cache_manifest.h"

#include <algorithm>
#include <ostream>
#include <set>

#include <nlohmann/json.hpp>

#include "weft/core/json.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/run/export/frame_sequence.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using OrderedJson = nlohmann::ordered_json;

constexpr int cache_manifest_version = 1, deepest_cache_manifest = 16;

OrderedJson surface_json(const SurfaceRecord& record, std::string_view kind) {
  OrderedJson json{{"name", record.subject().name},
                   {"kind", kind},
                   {"moves", record.subject().moves},
                   {"files", OrderedJson::array()}};
  for (const WrittenFile& file : record.written())
    json["files"].push_back({{"path", file.path.filename().string()},
                             {"format", file.format},
                             {"on", file.on_input ? "input" : "image"},
                             {"vertices", file.vertices}});
  return json;
}

struct ListedFile {
  std::string surface, path, format;
};

/// Files that a manifest lists; none where it is no manifest. Names with folders in them are not a
/// run's.
std::vector<ListedFile> listed_files(const fs::path& path) {
  std::vector<ListedFile> files;
  try {
    const nlohmann::json json = parse_json(read_file(path), deepest_cache_manifest);
    for (const auto& surface : json.at("surfaces"))
      for (const auto& file : surface.at("files"))
        files.push_back({surface.at("name"), file.at("path"), file.at("format")});
  } catch (const nlohmann::json::exception&) {
    return {};
  } catch (const JsonFault&) {
    return {};
  } catch (const InputError&) {
    return {};
  }
  std::erase_if(files, [](const ListedFile& file) {
    const fs::path name(file.path);
    return name.empty() || name == "." || name == ".." || name != name.filename();
  });
  return files;
}

/// Removes a file, or a folder of frames unless something else is in it.
void remove_listed(const fs::path& folder, const ListedFile& file) {
  const fs::path path = folder / file.path;
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) remove_frames(path, file.surface, file.format, 0);
  fs::remove(path, ignored);
}

}  // namespace

void write_cache_manifest(const fs::path& path, const CacheManifest& manifest,
                          std::span<const fs::path> inputs) {
  OrderedJson json{{"version", cache_manifest_version},
                   {"unit", manifest.files.unit.name},
                   {"metres_per_unit", manifest.files.unit.metres},
                   {"up", manifest.files.up()},
                   {"frame_rate", manifest.frame_rate},
                   {"first_frame", 0},
                   {"last_frame", manifest.frames - 1},
                   {"frames", manifest.frames},
                   {"surfaces", OrderedJson::array()}};
  for (const SurfaceRecord* record : manifest.cloths)
    json["surfaces"].push_back(surface_json(*record, "cloth"));
  for (const SurfaceRecord* record : manifest.bodies)
    json["surfaces"].push_back(surface_json(*record, "body"));
  const std::string text = json_text(json, 2);
  const std::vector<ListedFile> before = listed_files(path);
  write_file(path, [&](std::ostream& out) { out << text << '\n'; });
  std::set<std::string> now;
  for (const ListedFile& file : listed_files(path)) now.insert(file.path);
  for (const ListedFile& file : before) {
    const auto is_it = [&](const fs::path& input) {
      std::error_code ignored;
      const fs::path listed = path.parent_path() / file.path;
      return fs::equivalent(input, listed, ignored) ||
             fs::equivalent(input.parent_path(), listed, ignored);
    };
    if (now.count(file.path) == 0 && std::none_of(inputs.begin(), inputs.end(), is_it))
      remove_listed(path.parent_path(), file);
  }
}

}  // namespace weft
