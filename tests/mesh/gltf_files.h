#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "weft/core/json.h"

namespace weft::test {

/// Appends numbers as they lie in a little-endian file.
template <class Number>
void put(std::string& bytes, const std::vector<Number>& numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

inline std::string u32(std::size_t value) {
  std::string bytes;
  put(bytes, std::vector<std::uint32_t>{static_cast<std::uint32_t>(value)});
  return bytes;
}

/// A GLB container around JSON and a binary part, padded as the format asks.
inline std::string glb(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string chunks = u32(json.size()) + "JSON" + json;
  if (!binary.empty()) chunks += u32(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + u32(2) + u32(12 + chunks.size()) + chunks;
}

/// Two triangles that share an edge by position only, as programs write a crease: six float
/// positions, then six 16-bit indices. The JSON to change, and the binary part.
struct CreasedPair {
  nlohmann::json json = parse_json(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "bufferViews": [
      {"buffer": 0, "byteOffset": 0, "byteLength": 72},
      {"buffer": 0, "byteOffset": 72, "byteLength": 12}],
    "buffers": [{"byteLength": 84}]})",
                                   16);
  std::string binary = [] {
    std::string bytes;
    put(bytes, std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    put(bytes, std::vector<std::uint16_t>{0, 1, 2, 3, 4, 5});
    return bytes;
  }();
  [[nodiscard]] std::string bytes() const { return glb(json_text(json), binary); }
};

}  // namespace weft::test
