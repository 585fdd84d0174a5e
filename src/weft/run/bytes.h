#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "weft/vec.h"

namespace weft {

static_assert(std::endian::native == std::endian::little,
              "binary files are little-endian, written as values lie in memory");

/// Appends plain values to a string of bytes.
class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void add(T value) {
    const auto* first = reinterpret_cast<const char*>(&value);
    bytes_.append(first, sizeof(T));
  }
  void add_floats(const float* values, int count) {
    bytes_.append(reinterpret_cast<const char*>(values),
                  sizeof(float) * static_cast<std::size_t>(count));
  }
  void add_bytes(std::string_view bytes) { bytes_.append(bytes); }
  void add_text(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    add_bytes(text);
  }
  /// All that was added; the writer is empty afterwards.
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads values that ByteWriter wrote. Beyond the end `read` and `next` give zero, `read_floats`
/// changes nothing, and `whole` is false, so that callers check only before they allocate and at
/// the end.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void read(T& value) {
    value = T{};
    if (consume(sizeof(T))) std::memcpy(&value, consumed_.data(), sizeof(T));
  }
  template <class T>
  [[nodiscard]] T next() {
    T value{};
    read(value);
    return value;
  }
  void read_floats(float* values, int count) {
    if (consume(sizeof(float) * static_cast<std::size_t>(count)))
      std::memcpy(values, consumed_.data(), consumed_.size());
  }
  [[nodiscard]] std::string_view next_text() {
    const auto size = next<std::uint64_t>();
    return consume(size) ? consumed_ : std::string_view();
  }
  [[nodiscard]] bool whole() const { return whole_; }
  /// Bytes not read yet.
  [[nodiscard]] std::size_t left() const { return left_.size(); }

 private:
  bool consume(std::uint64_t count) {
    whole_ = whole_ && count <= left_.size();
    if (!whole_) return false;
    consumed_ = left_.substr(0, count);
    left_.remove_prefix(count);
    return true;
  }

  std::string_view left_, consumed_;
  bool whole_ = true;
};

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
