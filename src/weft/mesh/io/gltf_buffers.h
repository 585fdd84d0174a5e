#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weft/mesh/io/gltf_object.h"

namespace weft {

/// The two parts of a glTF file: text (.gltf) has no binary part.
struct GltfParts {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Splits a glTF file into its parts: a GLB container by its chunks, anything else as text.
/// @throws InputError for a container of another version, cut short, or of wrong lengths
GltfParts split_gltf(std::string_view bytes, std::string_view name);

/// The bytes of a glTF file's buffers, each fetched when it is first asked for: from the binary
/// part, from base64 text in the JSON, or from a file in the mesh's folder or below.
class GltfBuffers {
 public:
  /// @param binary  kept as a view
  /// @param folder  where files are looked for; none: they are refused
  GltfBuffers(const GltfObject& root, std::optional<std::string_view> binary,
              std::optional<std::filesystem::path> folder)
      : root_(root), binary_(binary), folder_(std::move(folder)) {}

  /// The part of a buffer that a buffer view names. @throws InputError
  std::string_view view(int buffer_view);
  /// What a uri of an object names. @throws InputError
  std::string_view resource(const GltfObject& object, const std::string& uri) {
    return fetch(object, uri);
  }
  /// The file that a uri names, relative to the folder; nothing for data in the uri itself, and for
  /// files elsewhere, which are refused when they are read.
  [[nodiscard]] static std::optional<std::filesystem::path> file_of(const std::string& uri);
  /// The files that buffers name, relative to the folder. @throws InputError
  [[nodiscard]] std::vector<std::filesystem::path> external_files() const;

 private:
  std::string_view buffer(int index);
  std::string_view fetch(const GltfObject& buffer, const std::string& uri);

  GltfObject root_;
  std::optional<std::string_view> binary_;
  std::optional<std::filesystem::path> folder_;
  std::map<int, std::string_view> buffers_;
  std::map<std::string, std::string> fetched_;  ///< by URI: several buffers may name one file
};

}  // namespace weft
