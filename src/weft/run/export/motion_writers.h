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

/// Formats whose files are made of a point cache when the motion is over.
bool is_made_of_cache(std::string_view format);

/// Where a surface's motion goes.
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

/// Writes one moment as DIR/NAME.FORMAT, where the format can hold it.
/// @return its path, or nothing for caches and images  @throws OutputError
std::optional<std::filesystem::path> write_still(std::string_view format, const MotionPlace& place,
                                                 const MotionFrame& frame);

}  // namespace weft
