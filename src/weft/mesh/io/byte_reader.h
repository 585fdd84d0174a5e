#pragma once

#include <cstdint>
#include <string_view>

#include "weft/core/assert.h"

namespace weft {

/// An unsigned integer from the first bytes of a view, whatever this machine's byte order.
/// @pre bytes holds at least sizeof(Unsigned)
template <class Unsigned>
Unsigned load_integer(std::string_view bytes, bool big_endian) {
  WEFT_ASSERT(bytes.size() >= sizeof(Unsigned));
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    const std::size_t place = big_endian ? sizeof(Unsigned) - 1 - i : i;
    value |= static_cast<Unsigned>(static_cast<Unsigned>(static_cast<unsigned char>(bytes[i]))
                                   << (8 * place));
  }
  return value;
}

/// IEEE 754 numbers of single and double precision, read like load_integer.
inline float load_float(std::string_view bytes, bool big_endian) {
  return __builtin_bit_cast(float, load_integer<std::uint32_t>(bytes, big_endian));
}
inline double load_double(std::string_view bytes, bool big_endian) {
  return __builtin_bit_cast(double, load_integer<std::uint64_t>(bytes, big_endian));
}

}  // namespace weft
