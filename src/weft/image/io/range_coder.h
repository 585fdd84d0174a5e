#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace weft {

/// How often a decision was 0 so far: the mean of a quick and of a slow estimate. No decision costs
/// less than a 44th of a bit, so that a file has a length in proportion to what it says.
class AdaptiveBit {
 public:
  /// Of a 0, in 4096ths.
  [[nodiscard]] std::uint32_t probability() const {
    constexpr std::uint32_t least = 64;
    return std::clamp((quick_ + slow_) >> 5U, least, 4096 - least);
  }
  void add(bool bit) {
    constexpr unsigned quickly = 4, slowly = 7;
    if (bit) {
      quick_ -= quick_ >> quickly;
      slow_ -= slow_ >> slowly;
    } else {
      quick_ += (65536 - quick_) >> quickly;
      slow_ += (65536 - slow_) >> slowly;
    }
  }

 private:
  std::uint32_t quick_ = 32768, slow_ = 32768;
};

/// An arithmetic coder of adaptive bits, with carries as in LZMA.
class RangeEncoder {
 public:
  void encode(AdaptiveBit& model, bool bit) {
    const std::uint32_t bound = (range_ >> 12U) * model.probability();
    model.add(bit);
    narrow(bound, bit);
  }
  /// A bit that is 0 as often as 1.
  void encode_even(bool bit) { narrow(range_ >> 1U, bit); }
  std::string finish() {
    for (int k = 0; k < 5; ++k) shift();
    return std::move(bytes_);
  }

 private:
  void narrow(std::uint32_t bound, bool bit) {
    if (bit) {
      low_ += bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    for (; range_ < (1U << 24U); range_ <<= 8U) shift();
  }
  /// Bytes of ones wait: a carry may still go through them.
  void shift() {
    if (low_ < 0xff000000U || low_ > 0xffffffffU) {
      const auto carry = static_cast<unsigned char>(low_ >> 32U);
      if (started_) bytes_ += static_cast<char>(first_ + carry);
      for (; waiting_ > 0; --waiting_)
        bytes_ += static_cast<char>(static_cast<unsigned char>(0xff + carry));
      started_ = true;
      first_ = static_cast<unsigned char>(low_ >> 24U);
    } else {
      ++waiting_;
    }
    low_ = (low_ & 0x00ffffffU) << 8U;
  }

  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xffffffffU;
  unsigned char first_ = 0;
  std::size_t waiting_ = 0;
  bool started_ = false;
  std::string bytes_;
};

/// Reads what a RangeEncoder wrote; behind its end there are zeros.
class RangeDecoder {
 public:
  /// @param bytes  kept as a view
  explicit RangeDecoder(std::string_view bytes) : bytes_(bytes) {
    for (int k = 0; k < 4; ++k) code_ = code_ << 8U | next();
  }
  bool decode(AdaptiveBit& model) {
    const bool bit = narrow((range_ >> 12U) * model.probability());
    model.add(bit);
    return bit;
  }
  bool decode_even() { return narrow(range_ >> 1U); }
  /// Whether more was read than there is.
  [[nodiscard]] bool is_short() const { return at_ > bytes_.size() + 4; }

 private:
  bool narrow(std::uint32_t bound) {
    const bool bit = code_ >= bound;
    if (bit) {
      code_ -= bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    for (; range_ < (1U << 24U); range_ <<= 8U) code_ = code_ << 8U | next();
    return bit;
  }
  std::uint32_t next() {
    const std::size_t at = at_++;
    return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint32_t code_ = 0, range_ = 0xffffffffU;
};

}  // namespace weft
