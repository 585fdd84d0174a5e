#include "weft/run/standstill_notes.h"

#include <algorithm>

#include <fmt/format.h>

#include "weft/run.h"

namespace weft {
namespace {

/// Part of all points that fall back in a frame, above which the run notes it.
constexpr double max_fallen_part = 0.01;

/// Part of a frame's time by which cloth may lag behind before the run notes it.
constexpr double max_lost_part = 0.01;

void note_fallen(RunReport& report) {
  const auto many = [&](const FrameReport& frame) {
    return frame.fell_back > max_fallen_part * report.particles;
  };
  const auto first = std::ranges::find_if(report.history, many);
  if (first == report.history.end()) return;
  report.notes.insert(
      report.notes.begin(),
      fmt::format("frame {}: {} of {} points were put back to where their step began, since they "
                  "had nowhere else to go; more substeps are wanted",
                  first - report.history.begin() + 1, first->fell_back, report.particles));
}

void note_lost_time(RunReport& report) {
  const auto worst = std::ranges::max_element(report.history, {}, &FrameReport::lost_time);
  const double frame_time = report.time_step * report.substeps;
  if (worst == report.history.end() || worst->lost_time <= max_lost_part * frame_time) return;
  report.notes.insert(
      report.notes.begin(),
      fmt::format("frame {}: cloth stood still for {:.0f} % of its time, since it would have "
                  "gained energy from nothing; more substeps are wanted",
                  worst - report.history.begin() + 1, 100 * worst->lost_time / frame_time));
}

}  // namespace

void note_what_stood_still(RunReport& report) {
  note_fallen(report);
  note_lost_time(report);
}

}  // namespace weft
