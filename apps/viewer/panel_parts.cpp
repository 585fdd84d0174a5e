#include "apps/viewer/panel_parts.h"

#include <algorithm>
#include <filesystem>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

namespace weft::viewer {
namespace {

constexpr std::array<const char*, 4> stage_names{"forces", "solve", "collide", "limit"};
constexpr std::array<ImU32, 4> stage_colours{
    IM_COL32(120, 160, 205, 255), IM_COL32(200, 90, 85, 255), IM_COL32(220, 170, 90, 255),
    IM_COL32(125, 175, 120, 255)};

float sum(const std::array<float, 4>& costs) { return costs[0] + costs[1] + costs[2] + costs[3]; }

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
namespace {

/// A font that reads well, where the system has it (Debian: fonts-dejavu-core).
constexpr const char* font_path = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float font_size = 14;  // [pixels] on a usual screen

void choose_font(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  // The font has Latin letters only; no others are used.
  if (std::filesystem::exists(font_path))
    io.Fonts->AddFontFromFileTTF(font_path, font_size * scale);
  else
    io.FontGlobalScale = scale;
}

void choose_colours() {
  ImGui::StyleColorsDark();
  ImVec4* colours = ImGui::GetStyle().Colors;
  const ImVec4 accent(0.78F, 0.30F, 0.30F, 1), quiet(0.24F, 0.25F, 0.27F, 1);
  colours[ImGuiCol_WindowBg] = ImVec4(0.13F, 0.135F, 0.145F, 0.96F);
  colours[ImGuiCol_PopupBg] = ImVec4(0.16F, 0.165F, 0.175F, 0.98F);
  colours[ImGuiCol_Text] = ImVec4(0.90F, 0.90F, 0.89F, 1);
  colours[ImGuiCol_TextDisabled] = ImVec4(0.60F, 0.61F, 0.62F, 1);
  colours[ImGuiCol_FrameBg] = quiet;
  colours[ImGuiCol_FrameBgHovered] = ImVec4(0.30F, 0.31F, 0.33F, 1);
  colours[ImGuiCol_FrameBgActive] = ImVec4(0.34F, 0.35F, 0.37F, 1);
  colours[ImGuiCol_Button] = quiet;
  colours[ImGuiCol_ButtonHovered] = ImVec4(0.34F, 0.35F, 0.37F, 1);
  colours[ImGuiCol_ButtonActive] = accent;
  colours[ImGuiCol_SliderGrab] = ImVec4(0.62F, 0.63F, 0.65F, 1);
  colours[ImGuiCol_SliderGrabActive] = accent;
  colours[ImGuiCol_Header] = ImVec4(0.19F, 0.195F, 0.21F, 1);
  colours[ImGuiCol_HeaderHovered] = ImVec4(0.27F, 0.28F, 0.30F, 1);
  colours[ImGuiCol_HeaderActive] = accent;
  colours[ImGuiCol_Separator] = ImVec4(0.28F, 0.29F, 0.31F, 1);
}

}  // namespace

PanelContext::PanelContext(GLFWwindow* window, double scale) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // nothing is left in the working directory
  choose_font(static_cast<float>(scale));
  choose_colours();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.ItemSpacing = ImVec2(8, 4);
  style.FramePadding = ImVec2(4, 2);
  style.ScaleAllSizes(static_cast<float>(scale));
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

PanelContext::~PanelContext() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void PanelContext::begin() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void PanelContext::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

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
  float max = 0;
  for (std::size_t i = 0; i < count_; ++i) max = std::max(max, sum(at(i)));
  return max;
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
      list.AddRectFilled({x, top}, {x + bar, y}, stage_colours[stage]);
      y = top;
    }
  }
  list.AddText({corner.x + 5, corner.y + 2}, IM_COL32(150, 152, 155, 255),
               fmt::format("{:.1f} ms", largest()).c_str());
  ImGui::Dummy({width, height});
  const Costs middle = usual();
  for (std::size_t stage = 0; stage < stages; ++stage) {
    if (stage % 2 == 1) ImGui::SameLine(0.5F * width);
    ImGui::PushStyleColor(ImGuiCol_Text, stage_colours[stage]);
    ImGui::Text("%-7s %6.2f", stage_names[stage], static_cast<double>(middle[stage]));
    ImGui::PopStyleColor();
  }
}

}  // namespace weft::viewer
