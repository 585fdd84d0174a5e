#include "fuzz/mesh_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return weft::fuzz::check_mesh(weft::fuzz::as_text(data, size), weft::parse_ply);
}
