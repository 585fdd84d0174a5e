#pragma once

#include <filesystem>

#include "weft/core/progress.h"
#include "weft/sim/run_folder.h"
#include "weft/view/surface_drawing.h"

namespace weft::app {

/// One frame of a run: cloths and bodies drawn from their images, and the ground. The camera sees
/// all of it.
/// @param frame  from 0; -1: the last
Picture draw_run(const RunFolder& run, int frame, const ViewFrom& options);

/// All frames as a movie that appears whole, from one camera that sees the first and the last
/// frame.
void film_run(const RunFolder& run, const std::filesystem::path& path, const ViewFrom& options,
              Progress* progress);

}  // namespace weft::app
