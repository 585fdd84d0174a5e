#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

#include <OpenEXR/ImfIO.h>

namespace weft {

/// Output to memory: OpenEXR writes a file's last table in a destructor, where the error of a full
/// disk would be lost.
class ExrMemory : public Imf::OStream {
 public:
  ExrMemory() : Imf::OStream("memory") {}
  void write(const char bytes[], int count) override {
    const auto end = static_cast<std::size_t>(position_) + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::memcpy(bytes_.data() + position_, bytes, static_cast<std::size_t>(count));
    position_ = end;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::uint64_t position_ = 0;
};

}  // namespace weft
