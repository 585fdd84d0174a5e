#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/run.h"

namespace weft {

/// The point caches of the samples of each surface of a scene, in its order.
struct RunCaches {
  std::filesystem::path folder;
  bool unwelded = false;                    ///< every sample a point
  std::vector<std::string> cloths, bodies;  ///< file names; empty where there is none
};
/// Writes the manifest that open_run_folder reads.
void write_run_manifest(const std::filesystem::path& path, const Scene& scene,
                        const RunReport& report, const RunCaches& caches);

/// Path of a cloth's rest positions, where its image does not tell them. [n x n] [m]
std::filesystem::path rest_path(const std::filesystem::path& folder, const std::string& cloth);
/// Path of a body's normal map as it was loaded, beside its image, so that drawing needs no mesh.
std::filesystem::path normals_path(const std::filesystem::path& folder, const std::string& body);

}  // namespace weft
