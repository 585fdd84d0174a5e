#include "weft/mesh/io/line_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh/io/byte_reader.h"

namespace weft {
namespace {

constexpr std::string_view utf8_mark = "\xef\xbb\xbf";
constexpr std::string_view little_endian_mark = "\xff\xfe", big_endian_mark = "\xfe\xff";

std::string ascii_of(std::string_view utf16, bool big_endian) {
  std::string text;
  text.reserve(utf16.size() / 2 + 1);
  for (std::size_t at = 0; at + 1 < utf16.size(); at += 2) {
    const auto unit = load_integer<std::uint16_t>(utf16.substr(at), big_endian);
    text.push_back(unit < 0x80 ? static_cast<char>(unit) : '?');
  }
  // Half a character is a file cut short, which a reader is to notice.
  if (utf16.size() % 2 != 0) text.push_back('?');
  return text;
}

// from_chars accepts no leading plus, which files may have.
std::string_view without_plus(std::string_view field) {
  return field.size() > 1 && field[0] == '+' && field[1] != '-' ? field.substr(1) : field;
}

/// A number that no double holds: 0 or an infinity, which a wider type tells apart.
double beyond_range(std::string_view field) {
  long double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc::result_out_of_range) return static_cast<double>(value);
  return field.find("e-") != field.npos || field.find("E-") != field.npos ? 0.0 : HUGE_VAL;
}

}  // namespace

std::optional<double> to_number(std::string_view field) {
  field = without_plus(field);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size() || error == std::errc::invalid_argument)
    return std::nullopt;
  return error == std::errc::result_out_of_range ? beyond_range(field) : value;
}

std::optional<std::int64_t> to_integer(std::string_view field) {
  field = without_plus(field);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size() || error != std::errc()) return std::nullopt;
  return value;
}

std::string_view coordinate_fault(double value) {
  if (!std::isfinite(value)) return "is not finite";
  if (std::fabs(value) > 1e30) return "is larger than 1e30";
  return {};
}

bool LineReader::next_line() {
  line_ = {};
  if (position_ >= bytes_.size()) return false;
  const std::size_t end = std::min(bytes_.find_first_of("\r\n", position_), bytes_.size());
  line_ = bytes_.substr(position_, end - position_);
  position_ = std::min(end + (bytes_.substr(end, 2) == "\r\n" ? 2 : 1), bytes_.size());
  ++number_;
  return true;
}

bool LineReader::next_filled_line() {
  while (next_line())
    if (has_field()) return true;
  return false;
}

bool LineReader::has_field() const {
  const std::size_t start = line_.find_first_not_of(" \t");
  return start != line_.npos && line_[start] != '#';
}

std::string LineReader::rest_as_name() {
  std::string name(next_field());
  for (std::string_view field = next_field(); !field.empty(); field = next_field())
    name.append(" ").append(field);
  return name;
}

std::string_view LineReader::next_field() {
  const std::size_t start = line_.find_first_not_of(" \t");
  if (start == line_.npos || line_[start] == '#') return line_ = {};
  const std::size_t end = std::min(line_.find_first_of(" \t", start), line_.size());
  const std::string_view field = line_.substr(start, end - start);
  line_.remove_prefix(end);
  return field;
}

double LineReader::coordinate() {
  const std::string_view field = next_field();
  if (field.empty()) fail("the line ends before three coordinates", "x y z are wanted");
  const std::optional<double> value = to_number(field);
  if (!value) fail(in_quotes(field) + " is not a number", "a coordinate is wanted");
  const std::string_view fault = coordinate_fault(*value);
  if (!fault.empty())
    fail(fmt::format("coordinate {} {}", in_quotes(field), fault), "a finite number is wanted");
  return *value;
}

std::int64_t LineReader::integer(std::string_view what, std::int64_t min, std::int64_t max) {
  const std::string_view field = next_field();
  if (field.empty()) fail(fmt::format("the line ends before {}", what), "an integer is wanted");
  const std::optional<std::int64_t> value = to_integer(field);
  if (!value || *value < min || *value > max)
    fail(fmt::format("{} is {}", what, in_quotes(field)),
         fmt::format("an integer from {} to {} is wanted", min, max));
  return *value;
}

void LineReader::fail(std::string_view found, std::string_view wanted) const {
  throw InputError(fmt::format("{}:{}", name_, number_), found, wanted);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t max = 32;
  std::string shown(text.substr(0, max));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return "'" + shown + (text.size() > max ? "...'" : "'");
}

std::string quoted_list(const std::vector<std::string>& names) {
  constexpr std::size_t max = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), max); ++i)
    list += (i == 0 ? "" : ", ") + in_quotes(names[i]);
  return names.size() > max ? list + fmt::format(" and {} more", names.size() - max) : list;
}

std::string_view plain_text(std::string_view bytes, std::string& decoded) {
  if (bytes.starts_with(utf8_mark)) return bytes.substr(utf8_mark.size());
  const bool big_endian = bytes.starts_with(big_endian_mark);
  if (!big_endian && !bytes.starts_with(little_endian_mark)) return bytes;
  return decoded = ascii_of(bytes.substr(little_endian_mark.size()), big_endian);
}

}  // namespace weft
