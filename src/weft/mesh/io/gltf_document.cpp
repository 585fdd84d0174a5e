#include "weft/mesh/io/gltf_document.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/json.h"
#include "weft/error.h"

namespace weft {
namespace {

constexpr int deepest_nesting = 64;

nlohmann::json parse_text(std::string_view text, std::string_view name) {
  try {
    return parse_json(text, deepest_nesting);
  } catch (const JsonFault& fault) {
    throw InputError(fault.place(name), fault.what(), fault.wanted("a glTF 2.0 mesh is wanted"));
  }
}

/// Refuses a file that requires an extension which changes the geometry, but for quantization.
void check_extensions(const GltfObject& root) {
  // These change how a surface looks or tell who made it, not where it is.
  constexpr std::array<std::string_view, 7> looks{"KHR_materials_", "KHR_texture_", "KHR_lights_",
                                                  "KHR_xmp",        "EXT_texture_", "MSFT_texture_",
                                                  "EXT_lights_"};
  for (const std::string& extension : root.texts("extensionsRequired")) {
    const bool harmless = extension == "KHR_mesh_quantization" ||
                          std::any_of(looks.begin(), looks.end(), [&](std::string_view prefix) {
                            return extension.starts_with(prefix);
                          });
    if (!harmless)
      root.fail(fmt::format("needs the extension {}", extension),
                "an uncompressed mesh of plain glTF 2.0 is wanted");
  }
}

void check_version(const GltfObject& root) {
  const std::optional<GltfObject> asset = root.object("asset");
  if (!asset) root.fail("has no asset", "a glTF 2.0 mesh is wanted");
  const std::string version = asset->text("version").value_or("");
  if (version.starts_with("1.")) root.fail("is glTF 1.0", "glTF 2.0 is wanted");
  if (!version.starts_with("2."))
    asset->fail(fmt::format("tells version '{}'", version), "glTF 2.0 is wanted");
}

}  // namespace

GltfDocument::GltfDocument(std::string_view bytes, std::string_view name,
                           std::optional<std::filesystem::path> folder)
    : size_(bytes.size()),
      parts_(split_gltf(bytes, name)),
      json_(std::make_unique<const nlohmann::json>(parse_text(parts_.json, name))),
      root_(*json_, name, ""),
      buffers_(root_, parts_.binary, std::move(folder)) {
  check_version(root_);
  check_extensions(root_);
}

GltfDocument::~GltfDocument() = default;

}  // namespace weft
