#include "apps/viewer/stage_plot.h"

#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

namespace weft::viewer {
namespace {

constexpr std::array<const char*, 4> names{"forces", "solve", "collide", "limit"};
constexpr std::array<ImU32, 4> colours{IM_COL32(120, 160, 205, 255), IM_COL32(200, 90, 85, 255),
                                       IM_COL32(220, 170, 90, 255), IM_COL32(125, 175, 120, 255)};

float sum(const std::array<float, 4>& costs) { return costs[0] + costs[1] + costs[2] + costs[3]; }

}  // namespace

void StagePlot::add(int frame, const FrameReport& report) {
  if (frame == last_frame_) return;
  if (frame < last_frame_) clear();
  last_frame_ = frame;
  if (!(report.milliseconds > 0)) return;
  costs_[next_] = {static_cast<float>(report.forces_ms), static_cast<float>(report.solve_ms),
                   static_cast<float>(report.collide_ms), static_cast<float>(report.limit_ms)};
  next_ = (next_ + 1) % kept;
  count_ = std::min(count_ + 1, kept);
}

float StagePlot::largest() const {
  float most = 0;
  for (std::size_t i = 0; i < count_; ++i) most = std::max(most, sum(at(i)));
  return most;
}

StagePlot::Costs StagePlot::usual() const {
  Costs middle{};
  std::array<float, kept> sorted{};
  for (std::size_t stage = 0; stage < stages && count_ > 0; ++stage) {
    for (std::size_t i = 0; i < count_; ++i) sorted[i] = at(i)[stage];
    const auto half = sorted.begin() + static_cast<std::ptrdiff_t>(count_ / 2);
    std::nth_element(sorted.begin(), half, sorted.begin() + static_cast<std::ptrdiff_t>(count_));
    middle[stage] = *half;
  }
  return middle;
}

void StagePlot::show(float height) const {
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + width, corner.y + height}, IM_COL32(24, 25, 27, 255), 3);
  const float scale = height / std::max(1.1F * largest(), 1e-3F), bar = width / kept;
  for (std::size_t i = 0; i < count_; ++i) {
    const float x = corner.x + bar * static_cast<float>(kept - count_ + i);
    float y = corner.y + height;
    for (std::size_t stage = 0; stage < stages; ++stage) {
      const float top = y - scale * at(i)[stage];
      list.AddRectFilled({x, top}, {x + bar, y}, colours[stage]);
      y = top;
    }
  }
  list.AddText({corner.x + 5, corner.y + 2}, IM_COL32(150, 152, 155, 255),
               fmt::format("{:.1f} ms", largest()).c_str());
  ImGui::Dummy({width, height});
  const Costs middle = usual();
  for (std::size_t stage = 0; stage < stages; ++stage) {
    if (stage % 2 == 1) ImGui::SameLine(0.5F * width);
    ImGui::PushStyleColor(ImGuiCol_Text, colours[stage]);
    ImGui::Text("%-7s %6.2f", names[stage], static_cast<double>(middle[stage]));
    ImGui::PopStyleColor();
  }
}

}  // namespace weft::viewer
