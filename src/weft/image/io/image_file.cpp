#include "weft/image_file.h"

#include <algorithm>
#include <cmath>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/image/image_colours.h"
#include "weft/image/io/compressed_image.h"
#include "weft/image/io/exr_codec.h"
#include "weft/image/io/metadata.h"
#include "weft/image/io/png_codec.h"
#include "weft/mesh_colours.h"

namespace weft {
namespace {

constexpr float full_scale = 65535;
constexpr int default_steps = 4095;  ///< of compressed images: 12 bits

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  write_file(path, [&](std::ostream& out) {
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

[[noreturn]] void refuse_ending(const std::filesystem::path& path) {
  throw UsageError(path.string(), "an ending that is no picture format here",
                   ".exr, .png or, of images, .weft is wanted");
}

template <class Change>
Planes3 changed(const Planes3& planes, const Change& change) {
  const int n = planes.size();
  Planes3 result(n);
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      const Vec3f p = planes.at(row, col);
      result.set(row, col, {change(p.x), change(p.y), change(p.z)});
    }
  return result;
}

// A picture of whole numbers from planes that hold such numbers.
PngPicture picture_of(const Planes3& whole, int bits) {
  const int n = whole.size();
  PngPicture picture{n, n, bits, {}, {}};
  picture.bytes.reserve(picture.row_bytes() * static_cast<std::size_t>(n));
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      const Vec3f p = whole.at(row, col);
      for (const float value : {p.x, p.y, p.z}) {
        const auto number = static_cast<unsigned>(value);
        if (bits == 16) picture.bytes.push_back(static_cast<std::uint8_t>(number >> 8U));
        picture.bytes.push_back(static_cast<std::uint8_t>(number & 0xffU));
      }
    }
  return picture;
}

Planes3 planes_of(const PngPicture& picture) {
  Planes3 planes(picture.width);
  const std::uint8_t* bytes = picture.bytes.data();
  const auto next = [&] {
    const float value = static_cast<float>(bytes[0] * 256 + bytes[1]) / full_scale;
    bytes += 2;
    return value;
  };
  for (int row = 0; row < picture.height; ++row)
    for (int col = 0; col < picture.width; ++col) {
      const float x = next();
      const float y = next();
      const float z = next();
      planes.set(row, col, {x, y, z});
    }
  return planes;
}

}  // namespace

std::string exr_bytes(const GeometryImage& image) {
  return encode_exr(stored_samples(image), metadata_text(image), image.colours);
}

std::string png_bytes(const GeometryImage& image) {
  const Planes3 whole =
      changed(stored_samples(image), [](float value) { return std::round(value * full_scale); });
  PngPicture picture = picture_of(whole, 16);
  GeometryImage rounded = image;  // the checksum is over the samples as they will be read
  rounded.cube = changed(whole, [](float value) { return value / full_scale; });
  picture.text = metadata_text(rounded);
  return encode_png(picture);
}

void write_image(const std::filesystem::path& path, const GeometryImage& image) {
  const std::string ending = ending_of(path);
  if (ending == ".exr") return write_bytes(path, exr_bytes(image));
  if (ending == ".png") return write_bytes(path, png_bytes(image));
  if (ending == ".weft") return write_compressed_image(path, image, default_steps);
  refuse_ending(path);
}

GeometryImage read_image(const std::filesystem::path& path) {
  return parse_image(read_file(path), path.string());
}

GeometryImage parse_image(std::string_view bytes, std::string_view where) {
  using std::string_view_literals::operator""sv;
  if (bytes.starts_with("\x76\x2f\x31\x01"sv)) {
    DecodedImage decoded = decode_exr(bytes, where);
    GeometryImage image = assemble_image(std::move(decoded.planes), decoded.text, where);
    image.colours = std::move(decoded.colours);
    check_colours(image, where);
    join_colours(image);
    return image;
  }
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) {
    const PngPicture picture = decode_png(bytes, where);
    return assemble_image(planes_of(picture), picture.text, where);
  }
  if (bytes.starts_with(compressed_mark)) return parse_compressed_image(bytes, where);
  throw InputError(where, "neither an EXR nor a PNG file", "a geometry image is wanted");
}

void write_colours(const std::filesystem::path& path, const Planes3& colours) {
  Planes3 whole(colours.size());
  for (int s = 0; s < colours.size() * colours.size(); ++s) {
    const auto [r, g, b] = display_bytes(colours.at(s));
    whole.set(s, {static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)});
  }
  write_bytes(path, encode_png(picture_of(whole, 8)));
}

void write_texture(const std::filesystem::path& path, const Planes3& texture) {
  write_bytes(path, encode_exr(texture, {}));
}

void write_normal_map(const std::filesystem::path& path, const NormalMap& normals) {
  const std::string ending = ending_of(path);
  if (ending == ".exr") return write_bytes(path, encode_exr(normals.normal, {}));
  if (ending != ".png") refuse_ending(path);
  const auto to_byte = [](float value) {
    return std::round(std::clamp(value, -1.0F, 1.0F) * 127.5F + 127.5F);
  };
  write_bytes(path, encode_png(picture_of(changed(normals.normal, to_byte), 8)));
}

}  // namespace weft
