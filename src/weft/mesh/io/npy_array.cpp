#include "weft/mesh/io/npy_array.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh/io/line_reader.h"

namespace weft {
namespace {

constexpr std::string_view signature{"\x93NUMPY", 6};
constexpr std::size_t max_axes = 32;  ///< of numpy before 2.0, which has 64; three are of use
constexpr std::string_view header_wanted = "a header as numpy writes it is wanted";

/// Reads the header: a Python dictionary of three keys, of which only what numpy writes is known.
class HeaderReader {
 public:
  HeaderReader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  void read(NpyArray& array) {
    want('{');
    while (!consume('}')) {
      const std::string key(quoted());
      if (std::find(found_.begin(), found_.end(), key) != found_.end())
        fail(fmt::format("the key {} twice", in_quotes(key)));
      want(':');
      if (key == "descr")
        read_type(array);
      else if (key == "fortran_order")
        array.fortran_order = truth();
      else if (key == "shape")
        read_shape(array);
      else
        fail(fmt::format("the key {}", in_quotes(key)));
      found_.push_back(key);
      if (!consume(',') && !at('}')) fail("an entry without end");
    }
    if (found_.size() != 3) fail(fmt::format("{} keys of 3", found_.size()));
  }

 private:
  [[noreturn]] void fail(std::string_view found) const {
    throw InputError(name_, fmt::format("has {} in its header", found), header_wanted);
  }
  bool at(char c) {
    while (!text_.empty() && (text_[0] == ' ' || text_[0] == '\n')) text_.remove_prefix(1);
    return !text_.empty() && text_[0] == c;
  }
  bool consume(char c) {
    const bool there = at(c);
    if (there) text_.remove_prefix(1);
    return there;
  }
  void want(char c) {
    if (!consume(c)) fail(fmt::format("no '{}'", c));
  }
  std::string_view quoted() {
    const char quote = at('"') ? '"' : '\'';
    want(quote);
    const std::size_t end = text_.find(quote);
    if (end == text_.npos) fail("a text without end");
    const std::string_view inside = text_.substr(0, end);
    text_.remove_prefix(end + 1);
    return inside;
  }
  bool truth() {
    at(' ');
    for (const auto& [word, value] : {std::pair{"True", true}, std::pair{"False", false}})
      if (text_.starts_with(word)) {
        text_.remove_prefix(std::string_view(word).size());
        return value;
      }
    fail("neither True nor False");
  }

  void read_type(NpyArray& array) {
    if (at('[')) throw InputError(name_, "holds records of several fields", "numbers are wanted");
    const std::string_view type = quoted();
    if (type.find('O') != type.npos)
      throw InputError(name_, "holds Python objects, which are never loaded",
                       "an array of numbers is wanted");
    const std::optional<std::int64_t> size =
        type.size() > 2 ? to_integer(type.substr(2)) : std::nullopt;
    const char kind = type.size() > 2 ? type[1] : '?';
    const bool floating = kind == 'f' && (size == 4 || size == 8);
    const bool whole =
        (kind == 'i' || kind == 'u') && (size == 1 || size == 2 || size == 4 || size == 8);
    if (!(floating || whole) || std::string_view("<>|=").find(type[0]) == std::string_view::npos)
      throw InputError(name_, fmt::format("holds numbers of the type {}", in_quotes(type)),
                       "float32 or float64 is wanted");
    array.kind = floating      ? NpyArray::Kind::floating
                 : kind == 'i' ? NpyArray::Kind::whole
                               : NpyArray::Kind::unsigned_whole;
    array.number_size = static_cast<std::size_t>(*size);
    array.big_endian = type[0] == '>';
  }

  void read_shape(NpyArray& array) {
    want('(');
    while (!consume(')')) {
      at(' ');
      std::size_t digits = 0;
      while (digits < text_.size() && text_[digits] >= '0' && text_[digits] <= '9') ++digits;
      const std::optional<std::int64_t> length = to_integer(text_.substr(0, digits));
      if (!length || array.shape.size() == max_axes) fail("a shape that is none");
      text_.remove_prefix(digits);
      array.shape.push_back(static_cast<std::size_t>(*length));
      if (!consume(',') && !at(')')) fail("a shape without end");
    }
  }

  std::string_view text_, name_;
  std::vector<std::string> found_;
};

/// @return header and rest
std::pair<std::string_view, std::string_view> split(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with(signature) || bytes.size() < 12)
    throw InputError(name, "does not begin as an array of numpy does", "a .npy file is wanted");
  const int version = static_cast<unsigned char>(bytes[6]);
  if (version < 1 || version > 3)
    throw InputError(name, fmt::format("is of version {}", version), "1, 2 or 3 is wanted");
  const std::size_t head = version == 1 ? 10 : 12;
  const std::size_t size = version == 1 ? load_integer<std::uint16_t>(bytes.substr(8), false)
                                        : load_integer<std::uint32_t>(bytes.substr(8), false);
  if (size > bytes.size() - head)
    throw InputError(name, "ends in its header", "a whole array is wanted");
  return {bytes.substr(head, size), bytes.substr(head + size)};
}

/// Whether a shape asks for as many numbers as there are; the product may not fit.
bool fits(const NpyArray& array) {
  std::size_t numbers = array.bytes.size() / array.number_size;
  if (array.bytes.size() % array.number_size != 0) return false;
  for (const std::size_t length : array.shape)
    if (length == 0) return array.bytes.empty();
  for (const std::size_t length : array.shape) {
    if (numbers % length != 0) return false;
    numbers /= length;
  }
  return numbers == 1;
}

std::uint64_t unsigned_at(std::string_view bytes, std::size_t size, bool big_endian) {
  switch (size) {
    case 1:
      return load_integer<std::uint8_t>(bytes, big_endian);
    case 2:
      return load_integer<std::uint16_t>(bytes, big_endian);
    case 4:
      return load_integer<std::uint32_t>(bytes, big_endian);
    default:
      return load_integer<std::uint64_t>(bytes, big_endian);
  }
}

}  // namespace

double NpyArray::at(std::size_t index) const {
  const std::string_view number = bytes.substr(index * number_size, number_size);
  if (kind == Kind::floating)
    return number_size == 4 ? load_float(number, big_endian) : load_double(number, big_endian);
  const std::uint64_t value = unsigned_at(number, number_size, big_endian);
  if (kind == Kind::unsigned_whole) return static_cast<double>(value);
  // The sign of fewer bits than 64 moves to the top and back.
  const unsigned spare = 64 - 8 * static_cast<unsigned>(number_size);
  return static_cast<double>(static_cast<std::int64_t>(value << spare) >> spare);
}

NpyArray parse_npy(std::string_view bytes, std::string_view name) {
  const auto [header, rest] = split(bytes, name);
  NpyArray array;
  HeaderReader(header, name).read(array);
  array.bytes = rest;
  if (!fits(array))
    throw InputError(name,
                     fmt::format("has {} bytes of {} each for the shape {}", rest.size(),
                                 array.number_size, shape_text(array.shape)),
                     "a whole array is wanted");
  return array;
}

std::string shape_text(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t length : shape)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", length);
  return fmt::format("({}{})", text, shape.size() == 1 ? "," : "");
}

}  // namespace weft
