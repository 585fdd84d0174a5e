#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace weft {

/// Memory that this process may still take without pushing out what others use: what the system
/// calls available, or less where a control group's limit (a container's, a batch job's) leaves
/// less. Nothing where the system does not tell.
/// @param root  of the file system, for tests
/// @return bytes
std::optional<std::uint64_t> available_memory(const std::filesystem::path& root = "/");

}  // namespace weft
