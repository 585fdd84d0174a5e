#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// An array of numbers in numpy's format (.npy), whose bytes are still those of the file.
struct NpyArray {
  enum class Kind { floating, whole, unsigned_whole };
  Kind kind = Kind::floating;
  std::size_t number_size = 8;  ///< bytes of a number
  bool big_endian = false;
  bool fortran_order = false;  ///< the first index runs fastest, otherwise the last
  std::vector<std::size_t> shape;
  std::string_view bytes;  ///< exactly the numbers

  [[nodiscard]] std::size_t count() const { return bytes.size() / number_size; }
  /// The number at a place in the file. @pre index < count()
  [[nodiscard]] double at(std::size_t index) const;
};

/// @param bytes  of the whole .npy file, kept as a view
/// @param name   what errors call the array
/// @throws InputError for what is no such file, or not whole; for Python objects, which are never
///         unpickled; for numbers that are no floats of 4 or 8 bytes or whole numbers of 1 to 8
NpyArray parse_npy(std::string_view bytes, std::string_view name);

/// A shape as numpy shows it.
std::string shape_text(const std::vector<std::size_t>& shape);

}  // namespace weft
