#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "apps/viewer/snapshot.h"
#include "weft/vec.h"

namespace weft::viewer {

/// Times of the window's own work, one for each of the last pictures [ms].
class WorkTimes {
 public:
  void add(double milliseconds);
  [[nodiscard]] double median() const { return part(0.5); }
  [[nodiscard]] double p95() const { return part(0.95); }

 private:
  [[nodiscard]] double part(double share) const;
  std::vector<double> times_;  // the last ones, in a ring
  std::size_t next_ = 0;
};

/// Report of the window when it closes, and in its status file before.
struct WindowReport {
  int frames = 0;  ///< drawn
  int width = 0, height = 0;
  WorkTimes draw;  ///< upload and draw calls of the processor, of pictures with something new
  std::vector<std::string> outputs;
};
/// @param middle  pixel of the middle sample of the first cloth
nlohmann::ordered_json to_json(const WindowReport& report, const Snapshot& snapshot,
                               const Status& status, Vec2d middle);

/// The first unused name for a picture in the folder: weft-view-0001.png and so on.
std::filesystem::path next_picture(const std::filesystem::path& folder);

}  // namespace weft::viewer
