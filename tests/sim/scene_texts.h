#pragma once

#include <string>

#include "tests/support/errors.h"
#include "weft/scene_file.h"

namespace weft::test {

/// What reading a scene says; empty where it reads.
inline std::string error_of(const std::string& text) {
  return message_of<SceneError>([&] { parse_scene(text, "s.json", ""); });
}

/// A scene of one cloth with these keys.
inline std::string with_cloth(const std::string& keys) { return R"({"cloths":[{)" + keys + "}]}"; }

}  // namespace weft::test
