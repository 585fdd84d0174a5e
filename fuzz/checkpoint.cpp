#include "weft/run/checkpoint.h"

#include <cstring>
#include <span>

#include "fuzz/properties.h"
#include "weft/core/hash.h"

namespace weft::fuzz {
namespace {

// Of the header: bytes that follow it and their hash, which nothing random would ever hit.
constexpr std::size_t size_at = 12, hash_at = 20, header_bytes = 28;

std::string with_fitting_header(std::string bytes) {
  if (bytes.size() < header_bytes) return bytes;
  Hash hash;
  hash.add(std::span<const char>(bytes).subspan(header_bytes));
  const std::uint64_t size = bytes.size() - header_bytes, value = hash.value();
  std::memcpy(bytes.data() + size_at, &size, sizeof(size));
  std::memcpy(bytes.data() + hash_at, &value, sizeof(value));
  return bytes;
}

void read_back(const std::string& bytes) {
  const auto checkpoint = read_or_refuse([&] { return decode_checkpoint(bytes, file_name); });
  if (!checkpoint) return;
  require(checkpoint->state.frame == static_cast<int>(checkpoint->history.size()),
          "every frame has its report");
  require(encode_checkpoint(*checkpoint) == bytes, "what is read is written as it was");
}

}  // namespace
}  // namespace weft::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace weft::fuzz;
  const std::string bytes(as_text(data, size));
  read_back(bytes);
  read_back(with_fitting_header(bytes));
  return 0;
}
