#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "weft/vec.h"

namespace weft {

static_assert(std::endian::native == std::endian::little,
              "PC2 is little-endian, read and written as it lies in memory");
static_assert(sizeof(Vec3f) == 12);

/// What a PC2 file begins with; its points follow, sample by sample.
struct Pc2Header {
  static constexpr std::array<char, 12> known_signature{'P', 'O', 'I', 'N', 'T', 'C',
                                                        'A', 'C', 'H', 'E', '2', '\0'};
  std::array<char, 12> signature = known_signature;
  std::int32_t version = 1;
  std::int32_t points = 0;
  float first = 0;  ///< frame of the first sample
  float step = 1;   ///< frames between two samples
  std::int32_t samples = 0;

  [[nodiscard]] bool is_known() const { return signature == known_signature; }
  /// Of a file of so many samples. @pre points and samples are not negative
  [[nodiscard]] std::uintmax_t file_bytes(std::int32_t count) const {
    return sizeof(Pc2Header) +
           sizeof(Vec3f) * static_cast<std::uintmax_t>(points) * static_cast<std::uintmax_t>(count);
  }
};
static_assert(sizeof(Pc2Header) == 32);

}  // namespace weft
