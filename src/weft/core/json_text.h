#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace weft {

/// JSON as text. Compiled once here: what writes JSON takes longer to compile than all that uses
/// it.
/// @param indent  spaces a level; -1: all in one line. Bytes that are no UTF-8, as paths may hold,
/// are replaced.
std::string json_text(const nlohmann::json& json, int indent = -1);
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace weft
