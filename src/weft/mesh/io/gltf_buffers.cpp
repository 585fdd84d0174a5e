#include "weft/mesh/io/gltf_buffers.h"

#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh/io/line_reader.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view container_mark = "glTF";
constexpr std::size_t container_head = 12;  // mark, version, length
constexpr std::size_t chunk_head = 8;       // length, kind
constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr std::int64_t max_bytes = std::numeric_limits<std::int64_t>::max() / 4;

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  return load_integer<std::uint32_t>(bytes.substr(at), false);
}

/// Removes the first chunk from the rest of a container. @return its kind and data
std::pair<std::uint32_t, std::string_view> take_chunk(std::string_view& rest,
                                                      std::string_view name) {
  const std::size_t room = rest.size() < chunk_head ? 0 : rest.size() - chunk_head;
  if (rest.size() < chunk_head || number_at(rest, 0) > room)
    throw InputError(name, fmt::format("a chunk that is longer than the {} bytes left", room),
                     "a whole GLB file is wanted");
  const std::pair chunk{number_at(rest, 4), rest.substr(chunk_head, number_at(rest, 0))};
  rest.remove_prefix(chunk_head + chunk.second.size());
  return chunk;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Decodes base64; nothing for any other text.
std::optional<std::string> from_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6U | static_cast<std::uint32_t>(digit)) & 0xffffU;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> static_cast<unsigned>(count) & 0xffU));
  }
  return bytes;
}

int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// Decodes the percent escapes of a URI.
std::string without_escapes(std::string_view uri) {
  std::string plain;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && hexadecimal_digit(uri[i + 1]) >= 0 &&
                        hexadecimal_digit(uri[i + 2]) >= 0;
    if (!escape) {
      plain.push_back(uri[i]);
      continue;
    }
    plain.push_back(
        static_cast<char>(16 * hexadecimal_digit(uri[i + 1]) + hexadecimal_digit(uri[i + 2])));
    i += 2;
  }
  return plain;
}

/// Whether the name of a file stays inside its folder.
bool is_below(const std::string& name) {
  const fs::path path(name);
  if (name.empty() || name.find(':') != name.npos || name.find('\0') != name.npos ||
      path.is_absolute())
    return false;
  for (const fs::path& part : path)
    if (part == "..") return false;
  return true;
}

}  // namespace

GltfParts split_gltf(std::string_view bytes, std::string_view name) {
  if (bytes.empty()) throw InputError(name, "is empty", "a glTF 2.0 mesh is wanted");
  if (!bytes.starts_with(container_mark)) return {bytes, std::nullopt};
  if (bytes.size() < container_head || number_at(bytes, 8) != bytes.size())
    throw InputError(
        name, fmt::format("is {} bytes long, which is not the length it tells", bytes.size()),
        "a whole GLB file is wanted");
  if (number_at(bytes, 4) == 1) throw InputError(name, "is glTF 1.0", "glTF 2.0 is wanted");
  if (number_at(bytes, 4) != 2)
    throw InputError(name, fmt::format("a GLB file of version {}", number_at(bytes, 4)),
                     "version 2 is wanted");
  std::string_view rest = bytes.substr(container_head);
  const auto [kind, json] = take_chunk(rest, name);
  if (kind != json_chunk)
    throw InputError(name, "its first chunk is not JSON", "a GLB file of version 2 is wanted");
  GltfParts parts{json, std::nullopt};
  while (!rest.empty()) {
    const auto [next_kind, data] = take_chunk(rest, name);
    if (next_kind == binary_chunk && !parts.binary) parts.binary = data;
  }
  return parts;
}

std::string_view GltfBuffers::view(int buffer_view) {
  const GltfObject object = root_.element("bufferViews", static_cast<std::size_t>(buffer_view));
  if (const std::optional<GltfObject> extensions = object.object("extensions"))
    if (extensions->has("EXT_meshopt_compression"))
      object.fail("is compressed by meshopt", "an uncompressed mesh is wanted");
  const std::optional<int> index = object.index("buffer", root_.count("buffers"));
  if (!index) object.fail("has no buffer", "one is wanted");
  const std::string_view bytes = buffer(*index);
  const auto size = static_cast<std::int64_t>(bytes.size());
  const std::int64_t offset = object.integer("byteOffset", 0, size).value_or(0);
  const std::int64_t length = object.wanted("byteLength", 0, size - offset);
  return bytes.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length));
}

std::optional<fs::path> GltfBuffers::file_of(const std::string& uri) {
  if (uri.starts_with("data:")) return std::nullopt;
  const std::string file = without_escapes(uri);
  return is_below(file) ? std::optional<fs::path>(file) : std::nullopt;
}

std::vector<fs::path> GltfBuffers::external_files() const {
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < root_.count("buffers"); ++i) {
    const std::optional<std::string> uri = root_.element("buffers", i).text("uri");
    if (!uri) continue;
    if (const std::optional<fs::path> file = file_of(*uri)) files.push_back(*file);
  }
  return files;
}

std::string_view GltfBuffers::buffer(int index) {
  if (const auto known = buffers_.find(index); known != buffers_.end()) return known->second;
  const GltfObject object = root_.element("buffers", static_cast<std::size_t>(index));
  const std::optional<std::string> uri = object.text("uri");
  if (!uri && (index != 0 || !binary_))
    object.fail("has no data", "a uri, or for the first one a binary chunk, is wanted");
  const std::string_view bytes = uri ? fetch(object, *uri) : *binary_;
  const auto told = static_cast<std::size_t>(object.wanted("byteLength", 1, max_bytes));
  if (told > bytes.size())
    object.fail(fmt::format("has {} bytes of {}", bytes.size(), told), "all of them are wanted");
  return buffers_[index] = bytes.substr(0, told);
}

std::string_view GltfBuffers::fetch(const GltfObject& buffer, const std::string& uri) {
  if (const auto known = fetched_.find(uri); known != fetched_.end()) return known->second;
  if (uri.starts_with("data:")) {
    const std::size_t mark = uri.find(";base64,");
    std::optional<std::string> bytes;
    if (mark != uri.npos) bytes = from_base64(std::string_view(uri).substr(mark + 8));
    if (!bytes) buffer.fail("holds data that are not base64", "base64 is wanted");
    return fetched_[uri] = std::move(*bytes);
  }
  const std::optional<fs::path> file = file_of(uri);
  if (!folder_ || !file)
    buffer.fail(fmt::format("lies in {}", in_quotes(uri)),
                "data in the file itself, or a file in the mesh's folder, are wanted");
  return fetched_[uri] = read_file(*folder_ / *file);
}

}  // namespace weft
