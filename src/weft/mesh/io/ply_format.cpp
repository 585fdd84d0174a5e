#include "weft/mesh/io/ply_format.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "weft/core/names.h"
#include "weft/error.h"
#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh/io/line_reader.h"
#include "weft/mesh/io/polygon.h"

namespace weft {

namespace {

/// The type of a name; none for any other word.
PlyType type_of(std::string_view field) {
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> names{{
      {"char", PlyType::int8},
      {"int8", PlyType::int8},
      {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},
      {"short", PlyType::int16},
      {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},
      {"uint16", PlyType::uint16},
      {"int", PlyType::int32},
      {"int32", PlyType::int32},
      {"uint", PlyType::uint32},
      {"uint32", PlyType::uint32},
      {"float", PlyType::float32},
      {"float32", PlyType::float32},
      {"double", PlyType::float64},
      {"float64", PlyType::float64},
  }};
  for (const auto& [name, type] : names)
    if (name == field) return type;
  return PlyType::none;
}

PlyType read_type(LineReader& reader) {
  const std::string_view field = reader.next_field();
  const PlyType type = type_of(field);
  if (type == PlyType::none)
    reader.fail("property type " + in_quotes(field), "a type from char to double is wanted");
  return type;
}

PlyFormat read_format(LineReader& reader) {
  const std::string_view format = reader.next_field();
  if (format == "ascii") return PlyFormat::ascii;
  if (format == "binary_little_endian") return PlyFormat::little_endian;
  if (format == "binary_big_endian") return PlyFormat::big_endian;
  reader.fail("format " + in_quotes(format),
              "ascii, binary_little_endian or binary_big_endian is wanted");
}

PlyElement read_element(LineReader& reader) {
  PlyElement element;
  element.name = reader.next_field();
  element.count = reader.integer("the number of " + in_quotes(element.name), 0, max_elements);
  return element;
}

PlyProperty read_property(LineReader& reader) {
  PlyProperty property;
  LineReader ahead = reader;
  if (ahead.next_field() == "list") {
    reader = ahead;
    property.count_type = read_type(reader);
    if (!is_integer(property.count_type))
      reader.fail("a list whose length is not an integer", "an integer type is wanted");
  }
  property.type = read_type(reader);
  property.name = reader.next_field();
  if (property.name.empty()) reader.fail("a property without a name", "a name is wanted");
  return property;
}

/// Minimum number of bytes of an item.
std::int64_t min_size(const PlyElement& element, PlyFormat format) {
  std::int64_t size = 0;
  for (const PlyProperty& property : element.properties) {
    const PlyType first = property.is_list() ? property.count_type : property.type;
    size += format == PlyFormat::ascii ? 2 : size_of(first);
  }
  return size;
}

/// Refuses counts that exceed the file's size, before they cause allocations or long loops.
void check_counts(const LineReader& reader, const PlyHeader& header) {
  // The last line of a text file may lack its end.
  const auto left = static_cast<std::int64_t>(reader.remaining().size()) + 1;
  std::int64_t needed = 0;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty() && element.count > 0)
      reader.fail("element " + in_quotes(element.name) + " has no properties", "some are wanted");
    needed += element.count * min_size(element, header.format);
    if (needed > left)
      reader.fail(fmt::format("{} of {} cannot fit into the {} bytes that follow", element.count,
                              in_quotes(element.name), left - 1),
                  "a whole file is wanted");
  }
}

/// Steps over a line of another program. One that reads like a property, or like a keyword in
/// capitals, is refused: without it all that follows would be taken for something else.
void skip_unknown(LineReader& reader, std::string_view keyword) {
  constexpr std::array<std::string_view, 4> known{"element", "property", "format", "end_header"};
  const std::string_view second = reader.next_field();
  const bool layout = second == "list" || type_of(second) != PlyType::none ||
                      std::find(known.begin(), known.end(), lower_case(keyword)) != known.end();
  if (layout)
    reader.fail("header line " + in_quotes(keyword), "element, property or end_header is wanted");
}

/// @return false after end_header
bool read_header_line(LineReader& reader, PlyHeader& header) {
  const std::string_view keyword = reader.next_field();
  if (keyword == "end_header") return false;
  if (keyword == "format") {
    header.format = read_format(reader);
  } else if (keyword == "element") {
    header.elements.push_back(read_element(reader));
  } else if (keyword == "property") {
    if (header.elements.empty()) reader.fail("a property before any element", "element is wanted");
    header.elements.back().properties.push_back(read_property(reader));
  } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
    skip_unknown(reader, keyword);
  }
  return true;
}

}  // namespace

int size_of(PlyType type) {
  switch (type) {
    case PlyType::none:
      return 0;
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 0;
}

PlyHeader read_ply_header(LineReader& reader) {
  reader.next_line();
  const std::string_view magic = reader.next_field();
  if (magic != "ply") reader.fail("begins with " + in_quotes(magic), "the keyword ply is wanted");
  PlyHeader header;
  do {
    if (!reader.next_line()) reader.fail("the file ends inside the header", "end_header is wanted");
  } while (read_header_line(reader, header));
  check_counts(reader, header);
  return header;
}

namespace {

double load(std::string_view bytes, PlyType type, bool big) {
  switch (type) {
    case PlyType::none:
      return 0;
    case PlyType::int8:
      return static_cast<std::int8_t>(load_integer<std::uint8_t>(bytes, big));
    case PlyType::uint8:
      return load_integer<std::uint8_t>(bytes, big);
    case PlyType::int16:
      return static_cast<std::int16_t>(load_integer<std::uint16_t>(bytes, big));
    case PlyType::uint16:
      return load_integer<std::uint16_t>(bytes, big);
    case PlyType::int32:
      return static_cast<std::int32_t>(load_integer<std::uint32_t>(bytes, big));
    case PlyType::uint32:
      return load_integer<std::uint32_t>(bytes, big);
    case PlyType::float32:
      return load_float(bytes, big);
    case PlyType::float64:
      return load_double(bytes, big);
  }
  return 0;
}

}  // namespace

void PlyValues::begin_item(const PlyElement& element, std::int64_t index) {
  element_ = &element;
  index_ = index;
  if (format_ == PlyFormat::ascii && !reader_->next_filled_line())
    fail(fmt::format("the file ends after {} of {} of {}", index, element.count,
                     in_quotes(element.name)),
         "a whole file is wanted");
}

void PlyValues::end_item() {
  if (format_ == PlyFormat::ascii && !reader_->next_field().empty())
    fail("more values in the line than the element has properties", "one item a line is wanted");
}

double PlyValues::next(PlyType type) {
  return format_ == PlyFormat::ascii ? next_text(type) : next_binary(type);
}

void PlyValues::expect_end() {
  if (format_ == PlyFormat::ascii ? reader_->next_filled_line() : !bytes_.empty())
    fail("content behind the last element", "no more than the header announces is wanted");
}

void PlyValues::fail(std::string_view found, std::string_view wanted) const {
  if (format_ == PlyFormat::ascii) reader_->fail(found, wanted);
  if (element_ == nullptr) throw InputError(name_, found, wanted);
  throw InputError(
      name_, fmt::format("element {} {}: {}", in_quotes(element_->name), index_, found), wanted);
}

double PlyValues::next_text(PlyType type) {
  const std::string_view field = reader_->next_field();
  if (field.empty()) fail("the line ends before all properties", "a whole line is wanted");
  const std::optional<double> value = to_number(field);
  if (!value || (is_integer(type) && *value != std::floor(*value)))
    fail(in_quotes(field) + " is not a number of the announced type", "one is wanted");
  return *value;
}

double PlyValues::next_binary(PlyType type) {
  const auto size = static_cast<std::size_t>(size_of(type));
  if (bytes_.size() < size) fail("the file ends here", "a whole file is wanted");
  const double value = load(bytes_, type, format_ == PlyFormat::big_endian);
  bytes_.remove_prefix(size);
  return value;
}

}  // namespace weft
