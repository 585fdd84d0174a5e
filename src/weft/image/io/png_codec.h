#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// An RGB picture and one text, as a PNG file keeps them.
struct PngPicture {
  int width = 0, height = 0;
  int bits = 16;                    ///< a channel: 8 or 16
  std::vector<std::uint8_t> bytes;  ///< rows from the top, R G B, 16-bit values high byte first
  std::string text;                 ///< iTXt under `metadata_key`; none when empty

  [[nodiscard]] std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * 3 * static_cast<std::size_t>(bits / 8);
  }
};

/// The picture as a PNG file. @pre sizes agree
std::string encode_png(const PngPicture& picture);

/// A geometry image's picture: 16 bits a channel, RGB, square, with metadata.
/// @param bytes  the whole file
/// @param where  what errors call it
/// @throws InputError for anything else, and for a damaged file
PngPicture decode_png(std::string_view bytes, std::string_view where);

}  // namespace weft
