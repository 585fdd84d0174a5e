#include "apps/viewer/report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft::viewer {
namespace {

constexpr std::size_t remembered = 1000;

}  // namespace

void WorkTimes::add(double milliseconds) {
  if (times_.size() < remembered)
    times_.push_back(milliseconds);
  else
    times_[next_++ % remembered] = milliseconds;
}

double WorkTimes::part(double share) const {
  if (times_.empty()) return 0;
  std::vector<double> sorted = times_;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

nlohmann::ordered_json to_json(const WindowReport& report, const Snapshot& snapshot,
                               const Status& status, Vec2d middle) {
  nlohmann::ordered_json json;
  json["input"] = {{"path", snapshot.subject ? snapshot.subject->name : ""}};
  json["frames"] = report.frames;
  json["window"] = {report.width, report.height};
  json["draw_ms"] = {{"median", report.draw.median()}, {"p95", report.draw.p95()}};
  json["subject"] = snapshot.subject ? snapshot.subject->number : 0;
  json["simulated_frames"] = snapshot.frame;
  json["running"] = snapshot.running;
  json["held"] = snapshot.held;
  const Vec3d centre = snapshot.centre_of_mass;
  json["centre_of_mass"] = {centre.x, centre.y, centre.z};
  json["middle"] = {middle.x, middle.y};
  json["stage"] = status.stage;
  json["message"] = status.message;
  json["error"] = status.error;
  json["outputs"] = report.outputs;
  return json;
}

std::filesystem::path next_picture(const std::filesystem::path& folder) {
  for (int number = 1;; ++number) {
    std::filesystem::path path = folder / fmt::format("weft-view-{:04}.png", number);
    if (!std::filesystem::exists(path)) return path;
  }
}

}  // namespace weft::viewer
