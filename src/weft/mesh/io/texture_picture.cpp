#include "weft/mesh/io/texture_picture.h"

#include <csetjmp>
#include <cstdio>  // before jpeglib.h, which needs it
#include <string>

#include <fmt/format.h>
#include <jpeglib.h>
#include <png.h>

#include "weft/error.h"

namespace weft {
namespace {

constexpr std::uint64_t max_pixels = std::uint64_t{1} << 26U;
constexpr std::string_view picture_wanted = "a whole PNG or JPEG picture is wanted";

void check_size(std::uint64_t width, std::uint64_t height, std::string_view name) {
  if (width == 0 || height == 0 || width * height > max_pixels)
    throw InputError(name, fmt::format("a picture of {} x {} pixels", width, height),
                     fmt::format("at most {} pixels are wanted", max_pixels));
}

/// libpng's simple interface, which frees what it holds when it fails.
struct PngFile {
  png_image image{};
  PngFile() { image.version = PNG_IMAGE_VERSION; }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;
  ~PngFile() { png_image_free(&image); }
};

TexturePicture decode_png_texture(std::string_view bytes, std::string_view name) {
  PngFile file;
  const auto require = [&](int done) {
    if (done == 0)
      throw InputError(name, fmt::format("a damaged PNG picture: {}", file.image.message),
                       picture_wanted);
  };
  require(png_image_begin_read_from_memory(&file.image, bytes.data(), bytes.size()));
  check_size(file.image.width, file.image.height, name);
  // With alpha, so that colours under what shines through stay as they are.
  file.image.format = PNG_FORMAT_RGBA;
  // Of 16 bits too, which libpng else takes for linear light where the file does not say.
  file.image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(file.image));
  require(png_image_finish_read(&file.image, nullptr, rgba.data(), 0, nullptr));
  TexturePicture picture{
      static_cast<int>(file.image.width), static_cast<int>(file.image.height), {}};
  picture.rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); i += 4)
    picture.rgb.insert(picture.rgb.end(), rgba.begin() + static_cast<std::ptrdiff_t>(i),
                       rgba.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  return picture;
}

// libjpeg reports errors by a function that must not return: it jumps, past nothing that has to be
// destroyed.
struct JpegErrors {
  jpeg_error_mgr manager;  // first, so that both have one address
  std::jmp_buf back;
  char message[JMSG_LENGTH_MAX];
};

void on_error(j_common_ptr file) {
  auto* errors = reinterpret_cast<JpegErrors*>(file->err);
  file->err->format_message(file, errors->message);
  std::longjmp(errors->back, 1);  // NOLINT(cert-err52-cpp)
}

/// Damage that libjpeg would fill with grey is an error, too.
void on_message(j_common_ptr file, int level) {
  if (level < 0) on_error(file);
}

class JpegFile {
 public:
  explicit JpegFile(std::string_view name) : name_(name) {
    file_.err = jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = on_error;
    errors_.manager.emit_message = on_message;
    jpeg_create_decompress(&file_);
  }
  JpegFile(const JpegFile&) = delete;
  JpegFile& operator=(const JpegFile&) = delete;
  ~JpegFile() { jpeg_destroy_decompress(&file_); }

  TexturePicture read(std::string_view bytes) {
    require(read_header(bytes));
    check_size(file_.image_width, file_.image_height, name_);
    if (file_.num_components == 4)
      throw InputError(name_, "a JPEG picture in four inks (CMYK)", "RGB or grey is wanted");
    TexturePicture picture{
        static_cast<int>(file_.image_width), static_cast<int>(file_.image_height), {}};
    picture.rgb.resize(std::size_t{3} * file_.image_width * file_.image_height);
    require(read_rows(picture.rgb.data()));
    return picture;
  }

 private:
  bool read_header(std::string_view bytes) {
    if (setjmp(errors_.back) != 0) return false;  // NOLINT(cert-err52-cpp)
    jpeg_mem_src(&file_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&file_, TRUE);
    file_.out_color_space = JCS_RGB;
    file_.dct_method = JDCT_ISLOW;  // the same bits on every processor
    return true;
  }
  bool read_rows(std::uint8_t* rgb) {
    if (setjmp(errors_.back) != 0) return false;  // NOLINT(cert-err52-cpp)
    jpeg_start_decompress(&file_);
    while (file_.output_scanline < file_.output_height) {
      JSAMPROW row = rgb + std::size_t{3} * file_.output_width * file_.output_scanline;
      jpeg_read_scanlines(&file_, &row, 1);
    }
    jpeg_finish_decompress(&file_);
    return true;
  }
  void require(bool done) const {
    if (!done)
      throw InputError(name_, fmt::format("a damaged JPEG picture: {}", errors_.message),
                       picture_wanted);
  }

  std::string_view name_;
  JpegErrors errors_{};
  jpeg_decompress_struct file_{};
};

}  // namespace

TexturePicture decode_texture(std::string_view bytes, std::string_view name) {
  using std::string_view_literals::operator""sv;
  if (bytes.starts_with("\x89PNG"sv)) return decode_png_texture(bytes, name);
  if (bytes.starts_with("\xff\xd8\xff"sv)) return JpegFile(name).read(bytes);
  throw InputError(name, "is neither a PNG nor a JPEG picture", picture_wanted);
}

}  // namespace weft
