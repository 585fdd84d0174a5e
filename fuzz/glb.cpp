#include "fuzz/mesh_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parse = [](std::string_view bytes, std::string_view name) {
    return weft::parse_gltf(bytes, name);
  };
  return weft::fuzz::check_mesh(weft::fuzz::as_text(data, size), parse);
}
