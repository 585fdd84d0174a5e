#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace weft {

/// What bytes of a kind begin with, and the words that refuse others.
struct Seal {
  std::string_view magic;     ///< of 8 bytes
  std::uint32_t version = 0;  ///< of the format
  std::string_view kind;      ///< a noun
  std::string_view wanted;    ///< what to do instead
};

/// Fields behind what tells whether they are whole: the magic, the format version, bytes and hash
/// of what follows, the version of Weft; little-endian.
std::string seal(const Seal& kind, std::string fields);

/// The fields of sealed bytes. @param where  for errors
/// @throws InputError for bytes that are damaged, cut short, of another version or another kind
std::string_view unseal(const Seal& kind, std::string_view bytes, const std::string& where);

/// Refuses bytes by one line. @throws InputError
[[noreturn]] void refuse(const Seal& kind, const std::string& where, std::string_view found);

}  // namespace weft
