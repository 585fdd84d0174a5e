#pragma once

#include <filesystem>

#include "weft/view/picture.h"

namespace weft::viewer {

/// What the window's own framebuffer holds. @param width, height  in pixels
Picture read_window(int width, int height);

/// A name in the folder that no file has: weft-view-0001.png and so on.
std::filesystem::path next_picture(const std::filesystem::path& folder);

}  // namespace weft::viewer
