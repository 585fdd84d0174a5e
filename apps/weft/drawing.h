#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "weft/core/progress.h"
#include "weft/sim/run_folder.h"
#include "weft/view/drawn_scene.h"
#include "weft/view/picture.h"

namespace weft::app {

/// How large pictures are, and from where things are seen.
struct DrawingOptions {
  int width = 1280, height = 720;           ///< pixels
  double azimuth = 0.45, elevation = 0.25;  ///< of the eye [rad]; azimuth 0 looks from +z
};

/// One frame of a run: cloths and bodies drawn from their images, and the ground. The camera sees
/// all of it.
/// @param frame  from 0; -1: the last
Picture draw_run(const RunFolder& run, int frame, const DrawingOptions& options);

/// All frames as a movie that appears whole, from one camera that sees the first and the last
/// frame.
void film_run(const RunFolder& run, const std::filesystem::path& path,
              const DrawingOptions& options, Progress* progress);

/// A mesh, some of its edges marked.
Picture draw_mesh(const TriangleMesh& mesh, const std::vector<std::array<int, 2>>& marked_edges,
                  const DrawingOptions& options);

}  // namespace weft::app
