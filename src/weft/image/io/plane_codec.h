#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "weft/geometry_image.h"

namespace weft {

/// Three whole numbers a sample of an image, [n * n] each. Mates have the same.
using WholePlanes = std::array<std::vector<int>, 3>;

/// Codes numbers from 0 to 65535: coarse levels first, what lies between by its difference from a
/// cubic through its neighbours in its chart, as wavelets by lifting do; each class of mates once,
/// holes never. Differences go through an arithmetic coder whose models are chosen by how large
/// those beside were.
std::string encode_planes(const WholePlanes& planes, const BorderMates& mates);

/// @param most  the largest number that may occur
/// @throws InputError for bytes that do not tell such numbers; those of holes are 0
WholePlanes decode_planes(std::string_view bytes, const BorderMates& mates, int most,
                          std::string_view where);

/// Bytes that an image of so many samples takes at least, so that readers know from a file's length
/// how much memory it may ask for.
std::size_t min_bytes(std::size_t samples);

}  // namespace weft
