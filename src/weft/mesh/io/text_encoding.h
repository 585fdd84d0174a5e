#pragma once

#include <string>
#include <string_view>

namespace weft {

/// A file's text without the byte-order mark that some programs put before it. UTF-16, which only
/// its mark tells from other bytes, becomes ASCII with a ? for every other character: such stand in
/// names and comments alone, which no reader of text keeps.
/// @param decoded  holds what was UTF-16; must live as long as the result, a view
std::string_view plain_text(std::string_view bytes, std::string& decoded);

}  // namespace weft
