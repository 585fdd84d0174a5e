#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "weft/convert.h"

namespace weft::app {

/// Peak memory of this process so far [MB of 10^6 bytes]; nothing where the system does not tell.
std::optional<double> peak_memory_mb();

using Json = nlohmann::ordered_json;

/// The parts of the commands' JSON, named as documented in docs/commands.
/// The genus, null of what is no oriented manifold.
Json genus_json(const TopologyCounts& counts);
/// "genus 1", or that there is none. @param genus  as reports hold it: a number or null
std::string genus_text(const Json& genus);

Json input_json(const std::string& path, const RepairedMesh& input);
Json conversion_json(const std::string& path, const Conversion& conversion,
                     const std::vector<std::filesystem::path>& outputs);
Json image_json(const GeometryImage& image);
/// {"lower", "upper"}, or null for an empty box.
Json box_json(const Box3d& box);
Json paths_json(const std::vector<std::filesystem::path>& paths);

/// Checks early that a file can be written. @throws OutputError, UsageError
void check_output(const std::filesystem::path& path,
                  std::initializer_list<std::string_view> endings);

}  // namespace weft::app
