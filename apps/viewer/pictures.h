#pragma once

#include <filesystem>

namespace weft::viewer {

/// A name in the folder that no file has: weft-view-0001.png and so on.
std::filesystem::path next_picture(const std::filesystem::path& folder);

}  // namespace weft::viewer
