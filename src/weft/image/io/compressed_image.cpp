#include "weft/image/io/compressed_image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <zlib.h>

#include "weft/core/assert.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/image/image_colours.h"
#include "weft/image/io/metadata.h"
#include "weft/image/io/plane_codec.h"
#include "weft/image_file.h"
#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh_colours.h"

namespace weft {
namespace {

constexpr std::uint32_t with_colours = 1;
constexpr int colour_steps = 255;
constexpr std::size_t number_size = 4;
/// Text that zlib makes of one byte at most.
constexpr std::size_t max_deflated = 1032;

int whole(float value, int steps) {
  return static_cast<int>(std::lround(static_cast<double>(value) * steps));
}

float unit(int value, int steps) { return static_cast<float>(static_cast<double>(value) / steps); }

WholePlanes whole_positions(const GeometryImage& image, int steps) {
  WholePlanes planes;
  for (int s = 0; s < image.size() * image.size(); ++s) {
    const Vec3f p = image.cube.at(s);
    planes[0].push_back(whole(p.x, steps));
    planes[1].push_back(whole(p.y, steps));
    planes[2].push_back(whole(p.z, steps));
  }
  return planes;
}

WholePlanes whole_colours(const GeometryImage& image) {
  WholePlanes planes;
  for (int s = 0; s < image.size() * image.size(); ++s) {
    const std::array<std::uint8_t, 3> colour = display_bytes(image.colours.at(s));
    for (std::size_t k = 0; k < 3; ++k) planes[k].push_back(colour[k]);
  }
  return planes;
}

Planes3 positions_of(const WholePlanes& planes, int size, int steps) {
  Planes3 cube(size);
  for (int s = 0; s < size * size; ++s) {
    const auto at = static_cast<std::size_t>(s);
    cube.set(s,
             {unit(planes[0][at], steps), unit(planes[1][at], steps), unit(planes[2][at], steps)});
  }
  return cube;
}

void put(std::string& bytes, std::uint32_t value) {
  for (unsigned k = 0; k < number_size; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xffU);
}

/// A part of the file: its length, then its bytes.
void put_part(std::string& bytes, const std::string& part) {
  put(bytes, static_cast<std::uint32_t>(part.size()));
  bytes += part;
}

std::string deflated(const std::string& text) {
  uLongf size = compressBound(text.size());
  std::string bytes(size, '\0');
  const int done = compress2(reinterpret_cast<Bytef*>(bytes.data()), &size,
                             reinterpret_cast<const Bytef*>(text.data()), text.size(), 9);
  WEFT_ASSERT(done == Z_OK);
  bytes.resize(size);
  return bytes;
}

/// Takes a file apart from its front.
class Parts {
 public:
  Parts(std::string_view bytes, std::string_view where) : rest_(bytes), where_(where) {}

  std::uint32_t number() { return load_integer<std::uint32_t>(take(number_size), false); }
  std::string_view part() { return take(number()); }
  std::string inflated(std::size_t size, std::string_view packed) {
    if (size > max_deflated * packed.size()) fail("metadata of a wrong length");
    std::string text(size, '\0');
    uLongf length = size;
    if (uncompress(reinterpret_cast<Bytef*>(text.data()), &length,
                   reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK ||
        length != size)
      fail("damaged metadata");
    return text;
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[noreturn]] void fail(const std::string& found) const {
    throw InputError(where_, "a compressed image with " + found,
                     "one that weft wrote, whole, is wanted");
  }

 private:
  std::string_view take(std::size_t count) {
    if (rest_.size() < count) fail("less in it than it tells");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_, where_;
};

std::size_t samples_of(std::uint32_t size) { return std::size_t{size} * size; }

void read_colours(Parts& parts, GeometryImage& image, std::string_view where) {
  const int n = image.size();
  const WholePlanes planes = decode_planes(parts.part(), image.mates, colour_steps, where);
  const Planes3 display = positions_of(planes, n, colour_steps);
  image.colours = Planes3(n);
  for (int s = 0; s < n * n; ++s) image.colours.set(s, linear_colour(display.at(s)));
  join_colours(image);
}

}  // namespace

GeometryImage quantised(const GeometryImage& image, int steps) {
  WEFT_ASSERT(steps >= 1 && steps <= largest_step_count);
  GeometryImage rounded = image;
  rounded.cube = positions_of(whole_positions(image, steps), image.size(), steps);
  return rounded;
}

std::optional<int> steps_for_error(const GeometryImage& image, double error) {
  // Half a step along each axis, and what single precision leaves of the samples besides.
  const double steps = std::ceil(1.001 * image.world.scale * std::numbers::sqrt3 / (2 * error));
  if (!(steps <= largest_step_count)) return std::nullopt;
  return std::max(1, static_cast<int>(steps));
}

std::string compressed_bytes(const GeometryImage& image, int steps) {
  const std::string text = metadata_text(quantised(image, steps));
  std::string bytes(compressed_mark);
  put(bytes, static_cast<std::uint32_t>(image.size()));
  put(bytes, static_cast<std::uint32_t>(steps));
  put(bytes, image.has_colours() ? with_colours : 0);
  put(bytes, static_cast<std::uint32_t>(text.size()));
  put_part(bytes, deflated(text));
  put_part(bytes, encode_planes(whole_positions(image, steps), image.mates));
  if (image.has_colours()) put_part(bytes, encode_planes(whole_colours(image), image.mates));
  return bytes;
}

void write_compressed_image(const std::filesystem::path& path, const GeometryImage& image,
                            int steps) {
  if (ending_of(path) != ".weft")
    throw UsageError(path.string(), "an ending that is not that of a compressed image",
                     ".weft is wanted");
  const std::string bytes = compressed_bytes(image, steps);
  write_file(path, [&](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

GeometryImage parse_compressed_image(std::string_view bytes, std::string_view where) {
  Parts parts(bytes.substr(compressed_mark.size()), where);
  const std::uint32_t size = parts.number(), steps = parts.number(), kinds = parts.number();
  require_image_size(size, size, where);
  if (steps < 1 || steps > largest_step_count || kinds > with_colours)
    parts.fail(fmt::format("{} steps of kind {}", steps, kinds));
  const std::uint32_t length = parts.number();
  const std::string text = parts.inflated(length, parts.part());
  const int n = static_cast<int>(size), most = static_cast<int>(steps);
  if (bytes.size() < min_bytes(samples_of(size))) parts.fail("fewer bytes than its samples take");
  const BorderMates mates = mates_in(text, n, where);
  const WholePlanes planes = decode_planes(parts.part(), mates, most, where);
  GeometryImage image = assemble_image(positions_of(planes, n, most), text, where);
  if (kinds == with_colours) read_colours(parts, image, where);
  if (!parts.at_end()) parts.fail("more behind its end");
  return image;
}

}  // namespace weft
