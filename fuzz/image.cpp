#include <bit>
#include <cstring>

#include <zlib.h>

#include "fuzz/properties.h"
#include "weft/image_file.h"

namespace weft::fuzz {
namespace {

constexpr std::size_t png_head = 8, chunk_frame = 12;  // signature; length, kind, checksum

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value = value << 8U | static_cast<std::uint8_t>(bytes[at + k]);
  return value;
}

/// A PNG file with the checksum of every chunk made right: or almost no change to a file would come
/// past libpng.
std::string with_checksums(std::string_view file) {
  std::string bytes(file);
  std::size_t at = png_head;
  while (at + chunk_frame <= bytes.size()) {
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - chunk_frame) break;
    const auto* start = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    const auto sum = static_cast<std::uint32_t>(crc32(0, start, static_cast<uInt>(length + 4)));
    for (std::size_t k = 0; k < 4; ++k)
      bytes[at + 8 + length + k] = static_cast<char>(sum >> (24 - 8 * k) & 0xffU);
    at += chunk_frame + length;
  }
  return bytes;
}

bool same_bits(const Planes3& a, const Planes3& b) {
  const auto same = [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
  };
  for (int sample = 0; sample < a.size() * a.size(); ++sample) {
    const Vec3f p = a.at(sample), q = b.at(sample);
    if (!same(p.x, q.x) || !same(p.y, q.y) || !same(p.z, q.z)) return false;
  }
  return true;
}

void require_same(const GeometryImage& a, const GeometryImage& b) {
  require(a.size() == b.size() && same_bits(a.cube, b.cube), "samples come back bit for bit");
  require(a.mates.intervals() == b.mates.intervals(), "mates come back");
  require(a.world.lower == b.world.lower && a.world.scale == b.world.scale,
          "the world map comes back");
  require(a.source == b.source && a.source_hash == b.source_hash, "the source comes back");
}

void require_sound(const GeometryImage& image) {
  require(image.size() >= min_image_size && image.size() <= largest_image_size,
          "the size is in range");
  for (int sample = 0; sample < image.size() * image.size(); ++sample) {
    const Vec3f p = image.cube.at(sample);
    for (const float x : {p.x, p.y, p.z}) require(x >= 0 && x <= 1, "samples lie in the cube");
  }
  require(mates_bit_equal(image), "mates are equal");
}

}  // namespace
}  // namespace weft::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace weft;
  using namespace weft::fuzz;
  std::string bytes(as_text(data, size));
  const bool is_png = bytes.starts_with("\x89PNG");
  if (is_png) bytes = with_checksums(bytes);
  const auto image = read_or_refuse([&] { return parse_image(bytes, file_name); });
  if (!image) return 0;
  require_sound(*image);
  require_same(*image, parse_image(exr_bytes(*image), "exr"));
  if (is_png) require_same(*image, parse_image(png_bytes(*image), "png"));
  return 0;
}
