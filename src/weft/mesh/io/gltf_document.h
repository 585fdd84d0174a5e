#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "weft/mesh/io/gltf_buffers.h"
#include "weft/mesh/io/gltf_object.h"

namespace weft {

/// An opened glTF file: its JSON, checked to be glTF 2.0 without extensions that change geometry,
/// and its buffers. After the specification [gltf20]; why not by a library:
/// docs/decisions/0019-own-gltf-reader.md.
class GltfDocument {
 public:
  /// @param bytes   kept as a view
  /// @param name    what errors call the file, kept as a view
  /// @param folder  where external buffers are looked for; none: they are refused
  /// @throws InputError for what is no such file
  GltfDocument(std::string_view bytes, std::string_view name,
               std::optional<std::filesystem::path> folder);
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;
  ~GltfDocument();

  [[nodiscard]] const GltfObject& root() const { return root_; }
  [[nodiscard]] GltfBuffers& buffers() { return buffers_; }
  /// Of the file without external buffers, in bytes.
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::size_t size_;
  GltfParts parts_;
  std::unique_ptr<const nlohmann::json> json_;
  GltfObject root_;
  GltfBuffers buffers_;
};

}  // namespace weft
