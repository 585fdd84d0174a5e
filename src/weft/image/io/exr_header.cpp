#include "weft/image/io/exr_header.h"

#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/image/io/metadata.h"

namespace weft {
namespace {

constexpr std::uint32_t version_number = 2;
constexpr std::uint32_t long_names_flag = 0x400;
constexpr std::size_t bytes_per_sample = 12;
constexpr int max_channels = 8;

// Reads a little-endian header from its front.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, std::string_view where) : rest_(bytes), where_(where) {}

  [[noreturn]] void fail(std::string_view found) const {
    throw InputError(where_, found, "a geometry image is wanted");
  }
  std::string_view take(std::size_t count) {
    if (count > rest_.size()) fail("a damaged EXR file: the header ends too early");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::uint32_t number() {
    const std::string_view bytes = take(4);
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k)
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k])) << (8 * k);
    return value;
  }
  std::string_view text() {
    const std::size_t size = rest_.find('\0');
    if (size == std::string_view::npos) fail("a damaged EXR file: the header ends too early");
    const std::string_view taken = take(size);
    take(1);
    return taken;
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_, where_;
};

void check_window(std::string_view value, std::size_t file_size, std::string_view where) {
  HeaderReader reader(value, where);
  const std::uint32_t left = reader.number();
  const std::uint32_t top = reader.number();
  const auto right = static_cast<std::int32_t>(reader.number());
  const auto bottom = static_cast<std::int32_t>(reader.number());
  if (left != 0 || top != 0) reader.fail("an EXR picture that was cropped");
  require_image_size(std::int64_t{right} + 1, std::int64_t{bottom} + 1, where);
  require_enough_bytes(right + 1, bytes_per_sample, file_size, where);
}

// The lossless methods come first in OpenEXR's list: none, RLE, ZIPS, ZIP, PIZ. The others would
// make mates differ, and their ratio of compression has no bound.
void check_compression(std::string_view value, std::string_view where) {
  constexpr char last_lossless = 4;
  if (value.size() != 1 || value[0] < 0 || value[0] > last_lossless)
    throw InputError(where, "an EXR picture whose compression loses something",
                     "a geometry image without loss is wanted");
}

// OpenEXR allocates lines for all channels, used or not.
void check_channel_list(std::string_view value, std::string_view where) {
  constexpr std::size_t description = 16;  // type, linearity, sampling
  HeaderReader reader(value, where);
  int count = 0;
  for (; !reader.text().empty(); reader.take(description))
    if (++count > max_channels)
      reader.fail(fmt::format("an EXR picture of more than {} channels", max_channels));
  if (!reader.at_end()) reader.fail("a damaged EXR file: a channel list of a wrong size");
}

// The preview is a small picture inside the header.
void check_preview(std::string_view value, std::string_view where) {
  HeaderReader reader(value, where);
  const std::uint64_t width = reader.number();
  const std::uint64_t height = reader.number();
  const std::uint64_t most = std::numeric_limits<std::uint16_t>::max();
  if (width > most || height > most || 4 * width * height + 8 != value.size())
    reader.fail("a damaged EXR file: a preview of a wrong size");
}

// Attribute types of fixed size [bytes].
constexpr std::array<std::pair<std::string_view, std::size_t>, 23> sizes_of_types{
    {{"box2f", 16},      {"box2i", 16},  {"chromaticities", 32},
     {"compression", 1}, {"double", 8},  {"envmap", 1},
     {"float", 4},       {"int", 4},     {"keycode", 28},
     {"lineOrder", 1},   {"m33d", 72},   {"m33f", 36},
     {"m44d", 128},      {"m44f", 64},   {"rational", 8},
     {"timecode", 8},    {"v2d", 16},    {"v2f", 8},
     {"v2i", 8},         {"v3d", 24},    {"v3f", 12},
     {"v3i", 12},        {"tiledesc", 9}}};

// OpenEXR reads an attribute by its type and ignores the size in the header: where the two differ
// it continues at another position than this reader. So types whose size cannot be checked here are
// refused.
void check_attribute(std::string_view type, std::string_view value, std::string_view where) {
  if (type == "string") return;
  if (type == "chlist") return check_channel_list(value, where);
  if (type == "preview") return check_preview(value, where);
  for (const auto& [known, size] : sizes_of_types)
    if (known == type && size == value.size()) return;
  throw InputError(where, "an EXR attribute of an unknown type or a wrong size",
                   "a geometry image is wanted");
}

}  // namespace

void check_exr_header(std::string_view bytes, std::string_view where) {
  HeaderReader reader(bytes, where);
  reader.number();  // the magic number, already checked
  if ((reader.number() & ~long_names_flag) != version_number)
    reader.fail("an EXR picture of tiles, layers of depth or several parts");
  std::set<std::string_view> names;
  for (std::string_view name = reader.text(); !name.empty(); name = reader.text()) {
    const std::string_view type = reader.text();
    const std::string_view value = reader.take(reader.number());
    if (!names.insert(name).second) reader.fail("a damaged EXR file: an attribute is there twice");
    check_attribute(type, value, where);
    if (name == "compression") check_compression(value, where);
    if (name == "dataWindow") check_window(value, bytes.size(), where);
  }
  if (!names.contains("dataWindow")) reader.fail("a damaged EXR file: no data window");
}

}  // namespace weft
