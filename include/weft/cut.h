#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace weft {

/// A path of vertices along which a user wants a mesh cut. Vertices are numbered from 0 in the
/// order of the mesh's file, whatever its format. Consecutive ones are joined by their edge, or by
/// the shortest path along edges where they share none.
struct SeamPath {
  int line = 0;  ///< of the seam's file
  std::vector<int> vertices;
};
struct Seam {
  std::string name;  ///< in error messages, mostly its path
  std::vector<SeamPath> paths;
};

/// Reads a seam file: one path a line, numbers separated by blanks, # begins a comment.
/// @throws InputError with FILE:LINE
Seam read_seam(const std::filesystem::path& path);

/// What `convert` reports of a cut.
struct CutSummary {
  int paths = 0;      ///< distinct curves: a mated pair counts once, true borders included
  int nodes = 0;      ///< distinct surface points where paths end
  double length = 0;  ///< of the interior cut, each curve once [m]
};

}  // namespace weft
