#include "weft/sim/export/pc2_writer.h"

#include <array>
#include <bit>
#include <cstring>

#include "weft/core/assert.h"
#include "weft/core/error.h"

namespace weft {
namespace {

static_assert(std::endian::native == std::endian::little,
              "PC2 is little-endian, written as it lies in memory");
static_assert(sizeof(Vec3f) == 12);

constexpr std::array<char, 12> signature{'P', 'O', 'I', 'N', 'T', 'C',
                                         'A', 'C', 'H', 'E', '2', '\0'};
constexpr std::int32_t version = 1;

template <class T>
void write_raw(std::ostream& out, T value) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(T));
  out.write(bytes.data(), bytes.size());
}

}  // namespace

Pc2Writer::Pc2Writer(const std::filesystem::path& path, int points)
    : path_(path), file_(path), out_(file_.temporary(), std::ios::binary), points_(points) {
  write_header();
}

void Pc2Writer::write_header() {
  out_.write(signature.data(), signature.size());
  write_raw(out_, version);
  write_raw(out_, std::int32_t{points_});
  write_raw(out_, 0.0F);  // first frame
  write_raw(out_, 1.0F);  // frames between two samples
  write_raw(out_, std::int32_t{frames_});
}

void Pc2Writer::add(std::span<const Vec3f> points) {
  WEFT_ASSERT(static_cast<int>(points.size()) == points_);
  const auto bytes = std::as_bytes(points);
  out_.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  if (!out_) throw OutputError(path_.string(), "cannot be written whole", "more room is wanted");
  ++frames_;
}

void Pc2Writer::finish() {
  out_.seekp(0);
  write_header();
  out_.close();
  if (!out_) throw OutputError(path_.string(), "cannot be written whole", "more room is wanted");
  file_.commit();
}

}  // namespace weft
