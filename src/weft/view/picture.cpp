#include "weft/picture.h"

#include <ostream>
#include <string>

#include <png.h>

#include "weft/error.h"
#include "weft/files.h"

namespace weft {
namespace {

/// More than any screen or poster; keeps a broken header from asking for all memory.
constexpr std::size_t max_pixels = std::size_t{1} << 28U;

/// libpng's state of one picture; its simplified interface reports by value, without long jumps.
struct PngImage {
  png_image state{};
  PngImage() { state.version = PNG_IMAGE_VERSION; }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() { png_image_free(&state); }
};

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture) {
  const std::size_t bytes = std::size_t{3} * picture.width * picture.height;
  if (picture.width < 1 || picture.height < 1 || picture.rgb.size() != bytes)
    throw OutputError(path.string(), "a picture without pixels",
                      "at least one row and column is wanted");
  PngImage image;
  image.state.width = static_cast<png_uint_32>(picture.width);
  image.state.height = static_cast<png_uint_32>(picture.height);
  image.state.format = PNG_FORMAT_RGB;
  std::string packed(PNG_IMAGE_PNG_SIZE_MAX(image.state), '\0');
  png_alloc_size_t used = packed.size();
  if (png_image_write_to_memory(&image.state, packed.data(), &used, 0, picture.rgb.data(), 0,
                                nullptr) == 0)
    throw OutputError(path.string(), image.state.message, "another size is wanted");
  packed.resize(used);
  write_file(path, [&](std::ostream& out) { out << packed; });
}

Picture read_png(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  PngImage image;
  if (png_image_begin_read_from_memory(&image.state, bytes.data(), bytes.size()) == 0)
    throw InputError(path.string(), image.state.message, "a PNG picture is wanted");
  if (std::size_t{image.state.width} * image.state.height > max_pixels)
    throw InputError(path.string(), "more than 2^28 pixels", "a smaller picture is wanted");
  image.state.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(image.state.width), static_cast<int>(image.state.height), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(image.state));
  const png_color black{0, 0, 0};
  if (png_image_finish_read(&image.state, &black, picture.rgb.data(), 0, nullptr) == 0)
    throw InputError(path.string(), image.state.message, "a whole PNG picture is wanted");
  return picture;
}

}  // namespace weft
