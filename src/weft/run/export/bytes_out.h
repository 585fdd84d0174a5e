#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <span>
#include <string>

#include "weft/vec.h"

namespace weft {

static_assert(std::endian::native == std::endian::little,
              "formats are little-endian and written as they lie in memory");
static_assert(sizeof(Vec3f) == 12);

/// Appends values as they lie in memory.
template <class T>
void append_raw(std::string& bytes, std::span<const T> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}
template <class T>
void append_raw(std::string& bytes, T value) {
  append_raw(bytes, std::span<const T>(&value, 1));
}
template <class T>
void write_raw(std::ostream& out, std::span<const T> values) {
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size_bytes()));
}

/// Appends the bytes of a 32-bit value, the most significant first.
template <class T>
void append_big_endian(std::string& bytes, T value) {
  static_assert(sizeof(T) == 4);
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes.push_back(static_cast<char>((bits >> static_cast<unsigned>(shift)) & 0xffU));
}

}  // namespace weft
