#include "weft/mesh/io/zip_file.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <zlib.h>

#include "weft/error.h"
#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh/io/line_reader.h"

namespace weft {
namespace {

// Records of the format, from PKWARE's APPNOTE: their marks and fixed lengths.
constexpr std::string_view end_mark{"PK\5\6", 4}, end64_mark{"PK\6\6", 4};
constexpr std::string_view locator_mark{"PK\6\7", 4}, entry_mark{"PK\1\2", 4};
constexpr std::string_view local_mark{"PK\3\4", 4};
constexpr std::size_t end_size = 22, end64_size = 56, locator_size = 20, entry_size = 46;
constexpr std::size_t local_size = 30, largest_comment = 65535;
constexpr std::uint32_t in_extra = 0xffffffff;  ///< says that a 64-bit extra field has the number
constexpr std::uint64_t max_deflated = 1032;    ///< bytes that one byte of deflate can become

std::uint64_t u16(std::string_view bytes, std::size_t at) {
  return load_integer<std::uint16_t>(bytes.substr(at), false);
}
std::uint64_t u32(std::string_view bytes, std::size_t at) {
  return load_integer<std::uint32_t>(bytes.substr(at), false);
}
std::uint64_t u64(std::string_view bytes, std::size_t at) {
  return load_integer<std::uint64_t>(bytes.substr(at), false);
}

[[noreturn]] void fail(std::string_view name, std::string_view found) {
  throw InputError(name, found, "a whole zip archive is wanted");
}

/// `size` bytes at a place that the archive tells.
std::string_view part(std::string_view bytes, std::uint64_t at, std::uint64_t size,
                      std::string_view name) {
  if (at > bytes.size() || size > bytes.size() - at)
    fail(name, fmt::format("is cut short: of {} bytes at {} {} are there", size, at,
                           at > bytes.size() ? 0 : bytes.size() - at));
  return bytes.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
}

/// Where the directory of all members lies.
struct Directory {
  std::uint64_t count = 0, size = 0, at = 0;
};

std::optional<Directory> directory_64(std::string_view bytes, std::size_t end,
                                      std::string_view name) {
  if (end < locator_size) return std::nullopt;
  const std::string_view locator = bytes.substr(end - locator_size, locator_size);
  if (!locator.starts_with(locator_mark)) return std::nullopt;
  const std::string_view record = part(bytes, u64(locator, 8), end64_size, name);
  if (!record.starts_with(end64_mark)) fail(name, "has no directory where it says");
  return Directory{u64(record, 32), u64(record, 40), u64(record, 48)};
}

Directory find_directory(std::string_view bytes, std::string_view name) {
  const std::size_t from =
      bytes.size() > end_size + largest_comment ? bytes.size() - end_size - largest_comment : 0;
  const std::size_t end = bytes.rfind(end_mark);
  if (end == bytes.npos || end < from || bytes.size() - end < end_size)
    fail(name, "does not end as a zip archive does");
  const std::string_view record = bytes.substr(end, end_size);
  if (u16(record, 4) != 0 && u16(record, 4) != 0xffff) fail(name, "is one of several parts");
  if (const auto found = directory_64(bytes, end, name)) return *found;
  return {u16(record, 10), u32(record, 12), u32(record, 16)};
}

/// Sizes and place of a member, which an extra field holds where 32 bits do not suffice.
struct Extent {
  std::uint64_t size, packed, at;
};

void read_extra(std::string_view extra, Extent& extent) {
  while (extra.size() >= 4) {
    const std::uint64_t kind = u16(extra, 0);
    const auto length = static_cast<std::size_t>(u16(extra, 2));
    std::string_view data = extra.substr(4, length);
    extra.remove_prefix(std::min(extra.size(), 4 + length));
    if (kind != 1) continue;
    for (std::uint64_t* value : {&extent.size, &extent.packed, &extent.at})
      if (*value == in_extra && data.size() >= 8) {
        *value = u64(data, 0);
        data.remove_prefix(8);
      }
  }
}

std::string_view data_of(std::string_view bytes, const Extent& extent, std::string_view name) {
  const std::string_view head = part(bytes, extent.at, local_size, name);
  if (!head.starts_with(local_mark)) fail(name, "has no member where it says");
  return part(bytes, extent.at + local_size + u16(head, 26) + u16(head, 28), extent.packed, name);
}

/// Parses the first entry of the rest of a directory, and goes on to what follows it.
ZipMember parse_entry(std::string_view bytes, std::string_view& rest, std::string_view name) {
  const std::string_view head = part(rest, 0, entry_size, name);
  if (!head.starts_with(entry_mark)) fail(name, "has a damaged directory");
  const std::uint64_t name_size = u16(head, 28), extra_size = u16(head, 30);
  const std::uint64_t all = entry_size + name_size + extra_size + u16(head, 32);
  const std::string_view entry = part(rest, 0, all, name);
  ZipMember member;
  member.name = part(entry, entry_size, name_size, name);
  const std::uint64_t method = u16(head, 10);
  if ((u16(head, 8) & 1U) != 0)
    throw InputError(name, fmt::format("{} is encrypted", in_quotes(member.name)),
                     "plain data are wanted");
  if (method != 0 && method != 8)
    throw InputError(name,
                     fmt::format("{} is compressed by method {}", in_quotes(member.name), method),
                     "deflate, or no compression, is wanted");
  Extent extent{u32(head, 24), u32(head, 20), u32(head, 42)};
  read_extra(part(entry, entry_size + name_size, extra_size, name), extent);
  member.data = data_of(bytes, extent, name);
  member.deflated = method == 8;
  member.size = extent.size;
  member.checksum = static_cast<std::uint32_t>(u32(head, 16));
  rest.remove_prefix(static_cast<std::size_t>(all));
  return member;
}

/// Unpacks a raw deflate stream of exactly `size` bytes; nothing for any other.
std::optional<std::string> inflated(std::string_view data, std::size_t size) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return std::nullopt;
  std::string out(size, '\0');
  constexpr std::size_t at_once = std::numeric_limits<uInt>::max();
  std::size_t taken = 0, made = 0;
  int state = Z_OK;
  while (state == Z_OK) {
    const auto offered = static_cast<uInt>(std::min(at_once, data.size() - taken));
    const auto room = static_cast<uInt>(std::min(at_once, size - made));
    // zlib does not write to its input, whatever its type says.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data() + taken));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + made);
    stream.avail_in = offered;
    stream.avail_out = room;
    state = inflate(&stream, Z_NO_FLUSH);
    taken += offered - stream.avail_in;
    made += room - stream.avail_out;
  }
  inflateEnd(&stream);
  if (state != Z_STREAM_END || made != size) return std::nullopt;
  return out;
}

}  // namespace

std::vector<ZipMember> zip_members(std::string_view bytes, std::string_view name) {
  if (!bytes.starts_with("PK")) fail(name, "does not begin as a zip archive does");
  const Directory directory = find_directory(bytes, name);
  std::string_view rest = part(bytes, directory.at, directory.size, name);
  std::vector<ZipMember> members;
  for (std::uint64_t i = 0; i < directory.count; ++i)
    members.push_back(parse_entry(bytes, rest, name));
  return members;
}

std::string unpack(const ZipMember& member, std::string_view name) {
  const std::string quoted = in_quotes(member.name);
  const bool fits = member.deflated ? member.size / max_deflated <= member.data.size()
                                    : member.size == member.data.size();
  if (!fits)
    fail(name, fmt::format("{} tells {} bytes, of which {} stand there", quoted, member.size,
                           member.data.size()));
  std::optional<std::string> bytes(member.data);
  if (member.deflated) bytes = inflated(member.data, static_cast<std::size_t>(member.size));
  if (!bytes) fail(name, fmt::format("{} cannot be unpacked", quoted));
  const auto sum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes->data()), bytes->size()));
  if (sum != member.checksum) fail(name, fmt::format("{} has another checksum", quoted));
  return std::move(*bytes);
}

}  // namespace weft
