#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "weft/run.h"
#include "weft/run/export/motion_writer.h"

namespace weft {

/// Whether files of a format are converted from a point cache after the run.
bool is_made_of_cache(std::string_view format);

/// Destination of a surface's motion.
struct MotionPlace {
  std::filesystem::path folder;  ///< DIR
  std::string name;              ///< of the surface
  std::filesystem::path cache;   ///< PC2 of the same vertices
  double frame_rate = 60;        ///< [1/s]
};
/// A writer of a format that holds motion: all but OBJ.
/// @param surface  must outlive it
std::unique_ptr<MotionWriter> make_motion_writer(std::string_view format, const MotionPlace& place,
                                                 const ExportedSurface& surface);

/// Writes a single frame as DIR/NAME.FORMAT, where the format can hold it.
/// @return its path, or nothing for caches and images  @throws OutputError
std::optional<std::filesystem::path> write_still(std::string_view format, const MotionPlace& place,
                                                 const MotionFrame& frame);

}  // namespace weft
