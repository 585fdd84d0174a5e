#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "weft/grid.h"

namespace weft {

/// A 64-bit hash of bytes in order (FNV-1a, Fowler/Noll/Vo): for naming states and inputs, not for
/// security. The same on every machine of one byte order.
class Hash {
 public:
  void add_bytes(std::span<const std::byte> bytes) {
    for (const std::byte b : bytes)
      value_ = (value_ ^ static_cast<std::uint8_t>(b)) * 0x100000001b3U;
  }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(std::span<const T> values) { add_bytes(std::as_bytes(values)); }
  /// The samples of a plane, row by row, padding left out.
  template <class T>
  void add(const Grid<T>& grid) {
    for (int r = 0; r < grid.rows(); ++r) add(std::span<const T>(grid.row(r), grid.cols()));
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }
  /// 16 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

}  // namespace weft
