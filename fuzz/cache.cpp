#include "fuzz/cache_properties.h"

/// The same bytes as PC2 and as MDD.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const auto parse : {weft::parse_pc2, weft::parse_mdd}) {
    const auto cache = weft::fuzz::read_or_refuse(
        [&] { return parse(weft::fuzz::as_text(data, size), weft::fuzz::file_name); });
    if (cache) weft::fuzz::require_sound(*cache);
  }
  return 0;
}
