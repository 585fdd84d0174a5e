#include "apps/viewer/panel_parts.h"

#include <algorithm>
#include <filesystem>

#include <imgui.h>

namespace weft::viewer {
namespace {

constexpr int legend_steps = 48;

ImU32 to_screen(Vec3f display) {
  const auto byte = [](float c) { return static_cast<int>(std::clamp(c, 0.0F, 1.0F) * 255.0F); };
  return IM_COL32(byte(display.x), byte(display.y), byte(display.z), 255);
}

}  // namespace

bool begin_section(const char* title) {
  return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
}

bool choose(const char* label, const std::vector<std::string>& names, std::string& chosen,
            const char* otherwise) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, chosen.empty() ? otherwise : chosen.c_str())) return false;
  for (const std::string& name : names) {
    const bool is_chosen = name == chosen;
    if (ImGui::Selectable(name.c_str(), is_chosen) && !is_chosen) {
      chosen = name;
      changed = true;
    }
    if (is_chosen) ImGui::SetItemDefaultFocus();
  }
  ImGui::EndCombo();
  return changed;
}

void number_line(const char* name, const std::string& value) {
  ImGui::TextDisabled("%s", name);
  const float width = ImGui::CalcTextSize(value.c_str()).x;
  ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
  ImGui::TextUnformatted(value.c_str());
}

void show_legend(const Legend& legend) {
  if (legend.title.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", legend.title.c_str());
  ImGui::PopStyleColor();
  if (!legend.colour) return;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 0.6F * ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int i = 0; i < legend_steps; ++i) {
    const float x0 = corner.x + width * static_cast<float>(i) / legend_steps;
    const float x1 = corner.x + width * static_cast<float>(i + 1) / legend_steps;
    list.AddRectFilled({x0, corner.y}, {x1, corner.y + height},
                       to_screen(legend.colour((i + 0.5) / legend_steps)));
  }
  const float line = corner.y + height + 2;
  for (const Legend::Mark& mark : legend.marks) {
    const float own = ImGui::CalcTextSize(mark.label.c_str()).x;
    const float x = corner.x + static_cast<float>(mark.place) * (width - own);
    list.AddText({x, line}, ImGui::GetColorU32(ImGuiCol_Text), mark.label.c_str());
  }
  ImGui::Dummy({width, height + 2 + ImGui::GetFontSize()});
}

std::vector<std::string> strings(std::span<const std::string_view> names) {
  return {names.begin(), names.end()};
}

std::string short_name(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  return name.empty() ? path : name;
}

}  // namespace weft::viewer
