#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "weft/mesh/io/line_reader.h"

namespace weft {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { none, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one value in a binary file.
int size_of(PlyType type);
inline bool is_integer(PlyType type) { return type < PlyType::float32; }

/// One value, or with a list a count and then so many values.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::none;
  PlyType count_type = PlyType::none;  ///< none: not a list
  [[nodiscard]] bool is_list() const { return count_type != PlyType::none; }
};

/// `count` items one after the other, each with all the properties in order.
struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// What the head of a PLY file says (Turk 1994).
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
};

/// Reads from the first line to end_header; what follows is the reader's `remaining`.
/// @throws InputError with the line, also when the counts cannot fit into what remains
PlyHeader read_ply_header(LineReader& reader);

}  // namespace weft
