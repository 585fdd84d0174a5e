#include "weft/image/io/png_codec.h"

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <stdexcept>

#include <png.h>

#include "weft/core/assert.h"
#include "weft/error.h"
#include "weft/image/io/metadata.h"

namespace weft {
namespace {

constexpr png_alloc_size_t min_chunk_memory = 4096;
constexpr png_uint_32 max_texts = 32;
constexpr std::size_t png_sample_bytes = 6;

// libpng reports errors by longjmp, which must not skip destructors: every call into libpng that
// can fail goes through `guarded`, whose step holds nothing to destroy.
struct Failure {
  char message[160] = "";
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
  std::strncpy(failure->message, message, sizeof failure->message - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

template <class Step>
bool guarded(png_structp png, const Step& step) {
  static_assert(std::is_trivially_destructible_v<Step>);
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp)
  step();
  return true;
}

class Writer {
 public:
  Writer()
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure_, on_error, on_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    if (info_ == nullptr) {
      png_destroy_write_struct(&png_, nullptr);
      throw std::bad_alloc();
    }
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png_, &info_); }

  std::string write(const PngPicture& picture) {
    png_set_write_fn(png_, &out_, append, [](png_structp) {});
    if (!guarded(png_, [&] { write_all(picture); })) throw std::runtime_error(failure_.message);
    return std::move(out_);
  }

 private:
  static void append(png_structp png, png_bytep data, std::size_t count) {
    auto* out = static_cast<std::string*>(png_get_io_ptr(png));
    bool done = true;
    try {
      out->append(reinterpret_cast<const char*>(data), count);
    } catch (const std::exception&) {
      done = false;
    }
    if (!done) png_error(png, "out of memory");
  }

  void write_all(const PngPicture& picture) {
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(picture.width),
                 static_cast<png_uint_32>(picture.height), picture.bits, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (!picture.text.empty()) {
      png_text text{};
      text.compression = PNG_ITXT_COMPRESSION_NONE;
      text.key = const_cast<char*>(metadata_key);
      text.text = const_cast<char*>(picture.text.c_str());
      text.itxt_length = picture.text.size();
      png_set_text(png_, info_, &text, 1);
    }
    png_write_info(png_, info_);
    for (int row = 0; row < picture.height; ++row)
      png_write_row(png_,
                    picture.bytes.data() + static_cast<std::size_t>(row) * picture.row_bytes());
    png_write_end(png_, info_);
  }

  Failure failure_;
  std::string out_;
  png_structp png_;
  png_infop info_;
};

class Reader {
 public:
  Reader(std::string_view bytes, std::string_view where)
      : rest_(bytes),
        where_(where),
        bytes_(bytes.size()),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure_, on_error, on_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &rest_, take);
    // Otherwise libpng allocates memory for any length in a chunk, with a warning at most.
    png_set_benign_errors(png_, 0);
    png_set_chunk_malloc_max(png_, std::max<png_alloc_size_t>(bytes.size(), min_chunk_memory));
    png_set_chunk_cache_max(png_, max_texts + 1);  // libpng keeps one back for itself
    png_set_crc_action(png_, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  PngPicture read() {
    require(guarded(png_, [this] { png_read_info(png_, info_); }));
    PngPicture picture;
    picture.text = metadata();
    if (picture.text.empty())
      throw InputError(where_, "a PNG picture that is no geometry image",
                       "one that weft wrote is wanted");
    if (png_get_bit_depth(png_, info_) != 16 ||
        png_get_color_type(png_, info_) != PNG_COLOR_TYPE_RGB ||
        png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE)
      throw InputError(where_, "a PNG picture of another kind",
                       "a geometry image of 16 bits a channel, RGB, is wanted");
    require_image_size(png_get_image_width(png_, info_), png_get_image_height(png_, info_), where_);
    picture.width = static_cast<int>(png_get_image_width(png_, info_));
    picture.height = static_cast<int>(png_get_image_height(png_, info_));
    require_enough_bytes(picture.width, png_sample_bytes, bytes_, where_);
    picture.bytes.resize(picture.row_bytes() * static_cast<std::size_t>(picture.height));
    require(guarded(png_, [this, &picture] { read_rows(picture); }));
    return picture;
  }

 private:
  static void take(png_structp png, png_bytep to, std::size_t count) {
    auto* rest = static_cast<std::string_view*>(png_get_io_ptr(png));
    if (rest->size() < count) png_error(png, "the file ends too early");
    std::memcpy(to, rest->data(), count);
    rest->remove_prefix(count);
  }

  void require(bool done) const {
    if (!done)
      throw InputError(where_, std::string("a damaged PNG file: ") + failure_.message,
                       "a geometry image is wanted");
  }

  [[nodiscard]] std::string metadata() const {
    png_textp texts = nullptr;
    int count = 0;
    png_get_text(png_, info_, &texts, &count);
    for (int k = 0; k < count; ++k)
      if (std::strcmp(texts[k].key, metadata_key) == 0) return texts[k].text;
    return {};
  }

  void read_rows(PngPicture& picture) {
    for (int row = 0; row < picture.height; ++row)
      png_read_row(png_, picture.bytes.data() + static_cast<std::size_t>(row) * picture.row_bytes(),
                   nullptr);
    png_read_end(png_, nullptr);
  }

  Failure failure_;
  std::string_view rest_, where_;
  std::size_t bytes_;
  png_structp png_;
  png_infop info_;
};

}  // namespace

std::string encode_png(const PngPicture& picture) {
  WEFT_ASSERT(picture.bytes.size() ==
              picture.row_bytes() * static_cast<std::size_t>(picture.height));
  return Writer().write(picture);
}

PngPicture decode_png(std::string_view bytes, std::string_view where) {
  return Reader(bytes, where).read();
}

}  // namespace weft
