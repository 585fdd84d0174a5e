#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace weft {

/// 8-bit RGB, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< [height * width * 3]
};
/// @throws OutputError
void write_png(const std::filesystem::path& path, const Picture& picture);
/// @throws InputError
Picture read_png(const std::filesystem::path& path);

}  // namespace weft
