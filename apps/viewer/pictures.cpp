#include "apps/viewer/pictures.h"

#include <algorithm>

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace weft::viewer {

Picture read_window(int width, int height) {
  Picture picture{width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height)};
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
  // OpenGL counts rows from the bottom.
  const std::size_t row = std::size_t{3} * width;
  for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(picture.rgb.begin() + row * top, picture.rgb.begin() + row * (top + 1),
                     picture.rgb.begin() + row * bottom);
  return picture;
}

std::filesystem::path next_picture(const std::filesystem::path& folder) {
  for (int number = 1;; ++number) {
    std::filesystem::path path = folder / fmt::format("weft-view-{:04}.png", number);
    if (!std::filesystem::exists(path)) return path;
  }
}

}  // namespace weft::viewer
