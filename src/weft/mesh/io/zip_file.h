#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// A file in a zip archive.
struct ZipMember {
  std::string name;
  std::string_view data;   ///< as stored in the archive
  bool deflated = false;   ///< otherwise stored as it is
  std::uint64_t size = 0;  ///< unpacked
  std::uint32_t checksum = 0;
};

/// The files of a zip archive (with its 64-bit extensions), of which nothing is unpacked yet.
/// @param bytes  kept as a view
/// @param name   what errors call the archive
/// @throws InputError for what is no whole archive, in parts, encrypted, or compressed by another
///         method than deflate
std::vector<ZipMember> zip_members(std::string_view bytes, std::string_view name);

/// @throws InputError for data that are damaged, or more or less than told
std::string unpack(const ZipMember& member, std::string_view name);

}  // namespace weft
