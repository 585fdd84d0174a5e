#pragma once

#include <cstdint>
#include <string_view>

#include "weft/mesh/io/ply_header.h"

namespace weft {

/// The values behind the header in order, text or binary; one line an item where the file is text.
class PlyValues {
 public:
  /// @param reader  behind the header; used on while this lives
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
