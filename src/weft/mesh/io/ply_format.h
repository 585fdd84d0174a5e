#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "weft/mesh/io/line_reader.h"

namespace weft {

enum class PlyFormat { ascii, little_endian, big_endian };
enum class PlyType { none, int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one value in a binary file.
int size_of(PlyType type);
inline bool is_integer(PlyType type) { return type < PlyType::float32; }

/// A property: one value, or for a list a count and then so many values.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::none;
  PlyType count_type = PlyType::none;  ///< none: not a list
  [[nodiscard]] bool is_list() const { return count_type != PlyType::none; }
};

/// An element: `count` items one after the other, each with all the properties in order.
struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// The header of a PLY file (Turk 1994).
struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
};

/// Reads from the first line to end_header; what follows is the reader's `remaining`.
/// @throws InputError with the line, also when the counts cannot fit into what remains
PlyHeader read_ply_header(LineReader& reader);

/// The values behind the header in order, text or binary; one line an item where the file is text.
class PlyValues {
 public:
  /// @param reader  behind the header; used as long as this lives
  /// @param name    what errors call the file, kept as a view
  PlyValues(LineReader& reader, PlyFormat format, std::string_view name)
      : reader_(&reader), format_(format), name_(name), bytes_(reader.remaining()) {}

  /// To be called before the values of each item. @throws InputError when there is none left
  void begin_item(const PlyElement& element, std::int64_t index);
  /// To be called behind the values of each item. @throws InputError when a line holds more
  void end_item();
  /// The next value, which is exact in a double whatever its type. @throws InputError
  double next(PlyType type);
  /// @throws InputError when something follows
  void expect_end();
  /// @throws InputError with the line, or the item in a binary file
  [[noreturn]] void fail(std::string_view found, std::string_view wanted) const;

 private:
  double next_text(PlyType type);
  double next_binary(PlyType type);

  LineReader* reader_;
  PlyFormat format_;
  std::string_view name_, bytes_;
  const PlyElement* element_ = nullptr;
  std::int64_t index_ = 0;
};

}  // namespace weft
