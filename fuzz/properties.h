#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "weft/error.h"

namespace weft::fuzz {

/// What the targets call the file that they read.
inline constexpr const char* file_name = "file";

/// Ends the program where libFuzzer notices it. Not an assert: those are off in some builds.
inline void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "property broken: %s\n", property);
  std::abort();
}

/// The result of reading, or nothing when the file was refused as the contract asks: by an error of
/// this library, in one line, that begins with the file's name. Any other exception ends the
/// program.
template <class Read>
std::optional<std::invoke_result_t<Read>> read_or_refuse(const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    const std::string_view line = error.what();
    require(line.starts_with(file_name), "an error names the file");
    require(line.find_first_of("\r\n") == line.npos, "an error is one line");
    require(error.code() == ExitCode::input, "an error of a file ends with exit code 3");
    return std::nullopt;
  }
}

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace weft::fuzz
