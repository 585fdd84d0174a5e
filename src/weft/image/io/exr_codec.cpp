#include "weft/image/io/exr_codec.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <vector>

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "weft/error.h"
#include "weft/image/io/exr_header.h"
#include "weft/image/io/exr_memory.h"
#include "weft/image/io/metadata.h"

namespace weft {
namespace {

using ChannelNames = std::array<const char*, 3>;
constexpr ChannelNames channel_names{"R", "G", "B"};
constexpr ChannelNames colour_names{"colour.R", "colour.G", "colour.B"};

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(std::string_view bytes) : Imf::IStream("memory"), bytes_(bytes) {}
  bool read(char to[], int count) override {
    if (count < 0 || position_ > bytes_.size() ||
        bytes_.size() - position_ < static_cast<std::size_t>(count))
      throw std::runtime_error("the file ends too early");
    std::memcpy(to, bytes_.data() + position_, static_cast<std::size_t>(count));
    position_ += static_cast<std::size_t>(count);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::string_view bytes_;
  std::uint64_t position_ = 0;
};

// OpenEXR takes one plane type for reading and writing, so the view is of mutable samples.
void add_slices(Imf::FrameBuffer& buffer, const ChannelNames& names, Planes3& planes) {
  const std::array<Grid<float>*, 3> grids{&planes.x, &planes.y, &planes.z};
  for (std::size_t k = 0; k < grids.size(); ++k)
    buffer.insert(names[k],
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(grids[k]->row(0)), sizeof(float),
                             sizeof(float) * static_cast<std::size_t>(grids[k]->stride())));
}

/// Half floats, which OpenEXR takes as such when it writes.
std::vector<Imath::half> halves(const Grid<float>& values) {
  std::vector<Imath::half> narrow;
  narrow.reserve(static_cast<std::size_t>(values.rows()) * values.cols());
  for (int r = 0; r < values.rows(); ++r)
    for (int c = 0; c < values.cols(); ++c) narrow.emplace_back(values(r, c));
  return narrow;
}

bool has_colours(const Imf::Header& header) {
  return std::all_of(colour_names.begin(), colour_names.end(), [&](const char* name) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    return channel != nullptr && channel->xSampling == 1 && channel->ySampling == 1;
  });
}

void check_channels(const Imf::Header& header, std::string_view where) {
  for (const char* name : channel_names) {
    const Imf::Channel* channel = header.channels().findChannel(name);
    if (channel == nullptr || channel->type != Imf::FLOAT || channel->xSampling != 1 ||
        channel->ySampling != 1)
      throw InputError(where, std::string("an EXR picture without a 32-bit float channel ") + name,
                       "a geometry image is wanted");
  }
}

DecodedImage decode(std::string_view bytes, std::string_view where) {
  check_exr_header(bytes, where);
  MemoryInput stream(bytes);
  Imf::InputFile file(stream);
  const Imf::Header& header = file.header();
  const auto* text = header.findTypedAttribute<Imf::StringAttribute>(metadata_key);
  if (text == nullptr)
    throw InputError(where, "an EXR picture that is no geometry image",
                     "one that weft wrote is wanted");
  check_channels(header, where);
  if (!file.isComplete())
    throw InputError(where, "an EXR file that was cut short", "a whole file is wanted");
  DecodedImage decoded{Planes3(header.dataWindow().max.x + 1), text->value(), {}};
  if (has_colours(header)) decoded.colours = Planes3(decoded.planes.size());
  Imf::FrameBuffer buffer;
  add_slices(buffer, channel_names, decoded.planes);
  if (has_colours(header)) add_slices(buffer, colour_names, decoded.colours);
  file.setFrameBuffer(buffer);
  file.readPixels(0, decoded.planes.size() - 1);
  return decoded;
}

}  // namespace

std::string encode_exr(const Planes3& planes, const std::string& text, const Planes3& colours) {
  Planes3 copy = planes;
  const std::array<std::vector<Imath::half>, 3> narrow{halves(colours.x), halves(colours.y),
                                                       halves(colours.z)};
  const int n = planes.size();
  Imf::Header header(n, n);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const char* name : channel_names) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  if (colours.size() > 0)
    for (const char* name : colour_names) header.channels().insert(name, Imf::Channel(Imf::HALF));
  if (!text.empty()) header.insert(metadata_key, Imf::StringAttribute(text));
  ExrMemory stream;
  {
    Imf::OutputFile file(stream, header, 0);
    Imf::FrameBuffer buffer;
    add_slices(buffer, channel_names, copy);
    if (colours.size() > 0)
      for (std::size_t k = 0; k < 3; ++k)
        buffer.insert(colour_names[k],
                      Imf::Slice(Imf::HALF,
                                 const_cast<char*>(reinterpret_cast<const char*>(narrow[k].data())),
                                 sizeof(Imath::half), sizeof(Imath::half) * n));
    file.setFrameBuffer(buffer);
    file.writePixels(n);
  }
  return stream.take();
}

DecodedImage decode_exr(std::string_view bytes, std::string_view where) {
  try {
    return decode(bytes, where);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(where, std::string("a damaged EXR file: ") + error.what(),
                     "a geometry image is wanted");
  }
}

}  // namespace weft
