#include "fuzz/cache_properties.h"
#include "weft/mesh/io/npy_array.h"

/// The bytes as an archive, and as an array that lies in one: checksums would hide it from damage.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = weft::fuzz::as_text(data, size);
  const auto array =
      weft::fuzz::read_or_refuse([&] { return weft::parse_npy(bytes, weft::fuzz::file_name); });
  if (array)
    for (std::size_t i = 0; i < array->count(); ++i) (void)array->at(i);
  const auto cache =
      weft::fuzz::read_or_refuse([&] { return weft::parse_npz(bytes, weft::fuzz::file_name); });
  if (cache) weft::fuzz::require_sound(*cache);
  return 0;
}
