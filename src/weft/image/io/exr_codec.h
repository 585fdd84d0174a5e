#pragma once

#include <string>
#include <string_view>

#include "weft/grid.h"

namespace weft {

/// Samples as an EXR file: float32 channels R, G, B = x, y, z, row 0 first, compressed without
/// loss.
/// @param text  kept as string attribute `metadata_key`; none when empty
/// @param colours  kept as half-float channels colour.R, colour.G, colour.B of the same size; none
///                 when empty
std::string encode_exr(const Planes3& planes, const std::string& text, const Planes3& colours = {});

/// The samples and the metadata text of a geometry image in an EXR file.
struct DecodedImage {
  Planes3 planes;
  std::string text;
  Planes3 colours;  ///< empty where the file has none
};
/// @param bytes  the whole file
/// @param where  what errors call it
/// @throws InputError when it is damaged, not square, or lacks the channels or the metadata
DecodedImage decode_exr(std::string_view bytes, std::string_view where);

}  // namespace weft
