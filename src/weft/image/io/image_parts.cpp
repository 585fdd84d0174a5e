#include "weft/image/io/image_parts.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <fmt/format.h>
#include <zlib.h>

#include "weft/error.h"
#include "weft/image/io/exr_memory.h"

namespace weft {
namespace {

/// Parts of one file have one display window, whatever their own sizes are: one that holds each.
Imath::Box2i window_of(const std::vector<ImagePart>& parts) {
  int rows = 1, cols = 1;
  for (const ImagePart& part : parts) {
    rows = std::max(rows, part.rows);
    cols = std::max(cols, part.cols);
  }
  return {{0, 0}, {cols - 1, rows - 1}};
}

Imf::Header header_of(const ImagePart& part, const Imath::Box2i& window) {
  Imf::Header header(window, {{0, 0}, {part.cols - 1, part.rows - 1}});
  header.setName(part.name);
  header.setType(Imf::SCANLINEIMAGE);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ImagePart::Channel& channel : part.channels)
    header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
  return header;
}

/// OpenEXR takes one plane type for reading and writing: nothing is written to these.
Imf::FrameBuffer buffer_of(const ImagePart& part) {
  Imf::FrameBuffer buffer;
  for (const ImagePart::Channel& channel : part.channels)
    buffer.insert(
        channel.name,
        Imf::Slice(Imf::FLOAT,
                   const_cast<char*>(reinterpret_cast<const char*>(channel.values.data())),
                   sizeof(float), sizeof(float) * static_cast<std::size_t>(part.cols)));
  return buffer;
}

/// Appends a number with its least byte first, whatever this machine's byte order.
template <class Unsigned>
void put(std::string& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
}
void put(std::string& bytes, float value) { put(bytes, std::bit_cast<std::uint32_t>(value)); }

/// An array in numpy's format, version 1.0.
std::string npy_of(const ImagePart& part) {
  constexpr std::size_t alignment = 64, before_header = 10;
  std::string header =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}, {}), }}", part.rows,
                  part.cols, part.channels.size());
  header.append(alignment - 1 - (before_header + header.size()) % alignment, ' ').append("\n");
  std::string bytes("\x93NUMPY\x01\x00", 8);
  put(bytes, static_cast<std::uint16_t>(header.size()));
  bytes += header;
  const auto samples = static_cast<std::size_t>(part.rows) * static_cast<std::size_t>(part.cols);
  for (std::size_t s = 0; s < samples; ++s)
    for (const ImagePart::Channel& channel : part.channels) put(bytes, channel.values[s]);
  return bytes;
}

/// What a zip archive tells of a member at both of its places, uncompressed, dated 1980.
std::string member_header(const std::string& name, const std::string& data) {
  constexpr std::uint16_t version = 20, stored = 0, first_day = 0x21;
  std::string bytes;
  put(bytes, version);
  put(bytes, std::uint16_t{1U << 11U});  // names are UTF-8
  put(bytes, stored);
  put(bytes, std::uint16_t{0});
  put(bytes, first_day);
  put(bytes, static_cast<std::uint32_t>(
                 crc32(0, reinterpret_cast<const Bytef*>(data.data()), data.size())));
  put(bytes, static_cast<std::uint32_t>(data.size()));
  put(bytes, static_cast<std::uint32_t>(data.size()));
  put(bytes, static_cast<std::uint16_t>(name.size()));
  put(bytes, std::uint16_t{0});
  return bytes;
}

/// A zip archive as it grows.
class Archive {
 public:
  void add(const std::string& name, const std::string& data) {
    const auto start = static_cast<std::uint32_t>(bytes_.size());
    const std::string header = member_header(name, data);
    bytes_.append("PK\x03\x04", 4).append(header).append(name).append(data);
    directory_.append("PK\x01\x02\x14\x00", 6).append(header);
    directory_.append(10, '\0');  // no comment, first disk, no attributes
    put(directory_, start);
    directory_ += name;
    ++members_;
  }
  std::string finish() {
    const auto start = static_cast<std::uint32_t>(bytes_.size());
    bytes_ += directory_;
    bytes_.append("PK\x05\x06\x00\x00\x00\x00", 8);
    put(bytes_, members_);
    put(bytes_, members_);
    put(bytes_, static_cast<std::uint32_t>(directory_.size()));
    put(bytes_, start);
    put(bytes_, std::uint16_t{0});
    if (bytes_.size() > std::numeric_limits<std::uint32_t>::max())
      throw OutputError("npz", fmt::format("{} bytes of panels", bytes_.size()),
                        "at most 4 GB are wanted");
    return std::move(bytes_);
  }

 private:
  std::string bytes_, directory_;
  std::uint16_t members_ = 0;
};

}  // namespace

std::string encode_exr_parts(const std::vector<ImagePart>& parts) {
  std::vector<Imf::Header> headers;
  headers.reserve(parts.size());
  const Imath::Box2i window = window_of(parts);
  for (const ImagePart& part : parts) headers.push_back(header_of(part, window));
  ExrMemory memory;
  {
    Imf::MultiPartOutputFile file(memory, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t p = 0; p < parts.size(); ++p) {
      Imf::OutputPart out(file, static_cast<int>(p));
      out.setFrameBuffer(buffer_of(parts[p]));
      out.writePixels(parts[p].rows);
    }
  }
  return memory.take();
}

std::string encode_npz_parts(const std::vector<ImagePart>& parts) {
  constexpr std::size_t most = std::numeric_limits<std::uint16_t>::max();
  if (parts.size() > most)
    throw OutputError("npz", fmt::format("{} arrays", parts.size()),
                      fmt::format("at most {} are wanted", most));
  Archive archive;
  for (const ImagePart& part : parts) {
    const std::string name = part.name + ".npy";
    if (name.size() > most)
      throw OutputError("npz", fmt::format("a name of {} bytes", part.name.size()),
                        fmt::format("at most {} are wanted", most - 4));
    archive.add(name, npy_of(part));
  }
  return archive.finish();
}

}  // namespace weft
