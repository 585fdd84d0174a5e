#include "weft/image/io/exr_header.h"

#include <cstdint>
#include <limits>
#include <string>

#include "weft/core/error.h"
#include "weft/image/io/metadata.h"

namespace weft {
namespace {

constexpr std::uint32_t version_number = 2;
constexpr std::uint32_t long_names_flag = 0x400;
constexpr std::size_t bytes_per_sample = 12;

// The rest of a header, little-endian, read from its front.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, std::string_view where) : rest_(bytes), where_(where) {}

  [[noreturn]] void fail(std::string_view found) const {
    throw InputError(where_, found, "a geometry image");
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

// A small picture inside the header, whose own size OpenEXR believes too.
void check_preview(std::string_view value, std::string_view where) {
  HeaderReader reader(value, where);
  const std::uint64_t width = reader.number();
  const std::uint64_t height = reader.number();
  const std::uint64_t most = std::numeric_limits<std::uint16_t>::max();
  if (width > most || height > most || 4 * width * height + 8 != value.size())
    reader.fail("a damaged EXR file: a preview of a wrong size");
}

}  // namespace

void check_exr_header(std::string_view bytes, std::string_view where) {
  HeaderReader reader(bytes, where);
  reader.number();  // the magic number that told the format
  if ((reader.number() & ~long_names_flag) != version_number)
    reader.fail("an EXR picture of tiles, layers of depth or several parts");
  bool has_window = false;
  for (std::string_view name = reader.text(); !name.empty(); name = reader.text()) {
    const std::string_view type = reader.text();
    const std::string_view value = reader.take(reader.number());
    if (type == "preview") check_preview(value, where);
    if (name != "dataWindow") continue;
    check_window(value, bytes.size(), where);
    has_window = true;
  }
  if (!has_window) reader.fail("a damaged EXR file: no data window");
}

}  // namespace weft
