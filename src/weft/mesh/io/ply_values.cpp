#include "weft/mesh/io/ply_values.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh/io/number.h"

namespace weft {
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
