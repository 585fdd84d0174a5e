#include "weft/mesh/io/text_encoding.h"

#include <cstdint>

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

}  // namespace

std::string_view plain_text(std::string_view bytes, std::string& decoded) {
  if (bytes.starts_with(utf8_mark)) return bytes.substr(utf8_mark.size());
  const bool big_endian = bytes.starts_with(big_endian_mark);
  if (!big_endian && !bytes.starts_with(little_endian_mark)) return bytes;
  return decoded = ascii_of(bytes.substr(little_endian_mark.size()), big_endian);
}

}  // namespace weft
