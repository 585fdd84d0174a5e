#include "apps/viewer/pictures.h"

#include <fmt/format.h>

namespace weft::viewer {

std::filesystem::path next_picture(const std::filesystem::path& folder) {
  for (int number = 1;; ++number) {
    std::filesystem::path path = folder / fmt::format("weft-view-{:04}.png", number);
    if (!std::filesystem::exists(path)) return path;
  }
}

}  // namespace weft::viewer
