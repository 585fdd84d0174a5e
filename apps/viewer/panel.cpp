#include "apps/viewer/panel.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <imgui.h>

#include "apps/viewer/colouring.h"
#include "apps/viewer/panel_parts.h"
#include "apps/viewer/scene_edit.h"
#include "weft/fabric.h"

namespace weft::viewer {
namespace {

constexpr float panel_width = 290, plot_height = 64,
                image_side = 140;  // [pixels] on a usual screen
const ImVec4 warning(0.98F, 0.55F, 0.45F, 1);
constexpr float strongest_wind = 12;  // [m/s]
constexpr int max_substeps = 16, max_level = 6;
constexpr const char* keys =
    "left drag: cloth, orbit   right drag: pan   wheel: zoom   Space pause   . step   R reset   "
    "F frame   C colours   H panel   S picture";

std::string body_name(const Scene& scene) {
  if (scene.bodies.empty()) return "none";
  if (scene.bodies.size() > 1) return fmt::format("{} bodies", scene.bodies.size());
  return short_name(scene.bodies[0].surface.name);
}

}  // namespace

int Panel::covered() const { return visible_ ? static_cast<int>(panel_width * scale_) : 0; }

bool Panel::takes_mouse(Vec2d at) const {
  // Lists that are open may reach beyond the panel.
  constexpr ImGuiPopupFlags any = ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel;
  return at.x < covered() || ImGui::IsPopupOpen("", any);
}

void Panel::remember(const Snapshot& snapshot) { plot_.add(snapshot.frame, snapshot.report); }

void Panel::follow(const PanelInput& input) {
  const std::uint64_t number = input.snapshot.subject ? input.snapshot.subject->number : 0;
  // A failed change is undone.
  const bool failed = !input.status.error.empty() && !ImGui::IsAnyItemActive();
  if (number == subject_ && !failed) return;
  subject_ = number;
  edited_ = number > 0 ? input.snapshot.subject->scene : std::nullopt;
}

void Panel::change(Wishes& wishes, const std::string& what) const {
  wishes.commands.push_back(Change{*edited_, what});
}

Wishes Panel::show(const PanelInput& input, Controls& controls) {
  Wishes wishes;
  follow(input);
  show_bottom_line(input);
  if (!input.status.stage.empty()) show_loading(input);
  if (!visible_) return wishes;
  const float line = ImGui::GetFrameHeight() + 6 * scale_;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({panel_width * scale_, ImGui::GetIO().DisplaySize.y - line});
  constexpr ImGuiWindowFlags fixed =
      ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
      ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("panel", nullptr, fixed)) {
    ImGui::PushItemWidth(-92 * scale_);
    show_head(input, controls, wishes);
    const Subject* subject = input.snapshot.subject.get();
    // A recorded run has nothing to change.
    if (subject != nullptr && (subject->scene || !subject->plays) && begin_section("Scene")) {
      if (edited_) show_scene(wishes);
      show_bodies(input, wishes);
    }
    if (edited_ && begin_section("Method")) show_methods(wishes);
    if (begin_section("Colours")) show_colours(input, controls);
    show_image(input);
    show_numbers(input);
    ImGui::PopItemWidth();
  }
  ImGui::End();
  return wishes;
}

void Panel::show_head(const PanelInput& input, Controls& controls, Wishes& wishes) {
  const Snapshot& now = input.snapshot;
  ImGui::TextUnformatted(now.subject ? short_name(now.subject->name).c_str() : "nothing yet");
  if (ImGui::IsItemHovered() && now.subject) ImGui::SetTooltip("%s", now.subject->name.c_str());
  if (now.subject && now.subject->plays) {
    const double rate = now.subject->scene ? now.subject->scene->frame_rate : 60;
    ImGui::TextDisabled("frame %d, %.2f s, %s", now.frame, now.frame / rate,
                        !now.running       ? "paused"
                        : now.speed > 0.97 ? "real time"
                                           : fmt::format("{:.2f} x real time", now.speed).c_str());
  } else {
    ImGui::TextDisabled("%s", now.subject ? "stands still" : "");
  }
  const float width = (ImGui::GetContentRegionAvail().x - 3 * ImGui::GetStyle().ItemSpacing.x) / 4;
  if (ImGui::Button(controls.running() ? "Pause" : "Play", {width, 0}))
    controls.play(!controls.running());
  ImGui::SameLine();
  if (ImGui::Button("Step", {width, 0})) controls.step();
  ImGui::SameLine();
  if (ImGui::Button("Reset", {width, 0})) wishes.commands.emplace_back(Reset{});
  ImGui::SameLine();
  if (ImGui::Button("Frame", {width, 0})) wishes.frame = true;
}

void Panel::show_scene(Wishes& wishes) {
  std::vector<std::string> materials;
  for (const NamedMaterial& named : named_materials()) materials.emplace_back(named.name);
  std::string material(material_name(*edited_));
  if (choose("material", materials, material, "the scene's own")) {
    set_material(*edited_, material);
    change(wishes, "material " + material);
  }
  auto friction = static_cast<float>(edited_->cloths[0].friction);
  ImGui::SliderFloat("friction", &friction, 0, 1, "%.2f");
  if (ImGui::IsItemActive()) set_friction(*edited_, static_cast<double>(friction));
  if (ImGui::IsItemDeactivatedAfterEdit()) change(wishes, fmt::format("friction {:.2f}", friction));
  show_wind(wishes);
}

void Panel::show_methods(Wishes& wishes) {
  std::string integrator(name_of(edited_->integrator));
  if (choose("integrator", strings(integrator_names()), integrator)) {
    set_integrator(*edited_, integrator);
    change(wishes, "integrator " + integrator);
  }
  std::string collider(name_of(edited_->collider));
  if (choose("collider", strings(collider_names()), collider)) {
    set_collider(*edited_, collider);
    change(wishes, "collider " + collider);
  }
  ImGui::SliderInt("substeps", &edited_->substeps, 1, max_substeps);
  if (ImGui::IsItemDeactivatedAfterEdit())
    change(wishes, fmt::format("{} substeps", edited_->substeps));
}

void Panel::show_wind(Wishes& wishes) {
  const Vec3d now = edited_->wind ? edited_->wind->velocity : Vec3d{};
  float wind[3] = {static_cast<float>(now.x), static_cast<float>(now.y), static_cast<float>(now.z)};
  ImGui::SliderFloat3("wind [m/s]", wind, -strongest_wind, strongest_wind, "%.1f");
  const Vec3d next{wind[0], wind[1], wind[2]};
  if (ImGui::IsItemActive()) set_wind(*edited_, next);
  if (ImGui::IsItemDeactivatedAfterEdit())
    change(wishes, fmt::format("wind {:.1f} m/s", length(next)));
}

void Panel::show_bodies(const PanelInput& input, Wishes& wishes) {
  const bool still = !input.snapshot.subject->scene;
  if (still) {
    if (ImGui::Button("Drape a sheet over it", {-1, 0}))
      wishes.commands.emplace_back(DrapeOver{input.snapshot.subject->name});
    return;
  }
  std::vector<std::string> bodies{"as opened", "none"};
  for (const std::string& name : builtin_bodies()) bodies.push_back(name);
  std::string body = body_name(*edited_);
  if (!choose("body", bodies, body, body.c_str())) return;
  if (body == "none") {
    remove_bodies(*edited_);
    change(wishes, "no body");
  } else {
    wishes.commands.emplace_back(DrapeOver{body == "as opened" ? "" : body});
  }
}

void Panel::show_colours(const PanelInput& input, Controls& controls) {
  Colouring colouring = controls.colouring();
  std::string by(colour_names[static_cast<std::size_t>(colouring.by)]);
  if (choose("show", strings(colour_names), by))
    colouring.by = static_cast<ColourBy>(std::find(colour_names.begin(), colour_names.end(), by) -
                                         colour_names.begin());
  if (colouring.by == ColourBy::mip) ImGui::SliderInt("level", &colouring.level, 0, max_level);
  controls.set_colouring(colouring);
  const auto& subject = input.snapshot.subject;
  const double limit =
      subject && subject->scene ? subject->scene->cloths[0].material.strain_limit : 0;
  // The legend is that of the current snapshot, which follows a choice one picture later.
  show_legend(legend_of(input.snapshot.colouring, limit));
}

void Panel::show_numbers(const PanelInput& input) const {
  const Snapshot& now = input.snapshot;
  if (!now.subject || !now.subject->scene) return;
  if (!begin_section("Cost of a frame [ms]")) return;
  plot_.show(plot_height * scale_);
  ImGui::TextDisabled("drawing a picture: %.2f", input.draw_ms);
  if (!begin_section("Measured")) return;
  const FrameReport& report = now.report;
  number_line("strain p99 / max",
              fmt::format("{:.2f} % / {:.2f} %", 100 * report.strain.p99, 100 * report.strain.max));
  number_line("contacts / with cloth",
              fmt::format("{} / {}", report.contacts, report.self_contacts));
  number_line("smallest gap", std::isfinite(report.smallest_gap)
                                  ? fmt::format("{:.2f} mm", 1000 * report.smallest_gap)
                                  : "nothing near");
  number_line("residual", fmt::format("{:.1e}", report.residual));
}

void Panel::show_image(const PanelInput& input) {
  if (input.image_texture == 0 || !shows_image_ || !begin_section("Geometry image")) return;
  const float side = std::min(ImGui::GetContentRegionAvail().x, image_side * scale_);
  ImGui::SetCursorPosX(0.5F * (ImGui::GetWindowContentRegionMax().x - side));
  // ImGui's OpenGL backend takes a texture's name for a pointer.
  const auto name = static_cast<std::uintptr_t>(input.image_texture);
  ImGui::Image(reinterpret_cast<ImTextureID>(name),  // NOLINT(performance-no-int-to-ptr)
               {side, side});
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("The surface itself: x, y, z of every sample as red, green, blue.");
}

void Panel::show_bottom_line(const PanelInput& input) const {
  const float height = ImGui::GetFrameHeight() + 6 * scale_;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, size.y - height});
  ImGui::SetNextWindowSize({size.x, height});
  constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs;
  if (ImGui::Begin("line", nullptr, fixed)) {
    if (!input.status.error.empty())
      ImGui::TextColored(warning, "%s", input.status.error.c_str());
    else
      ImGui::TextUnformatted(input.status.message.c_str());
    const float width = ImGui::CalcTextSize(keys).x;
    const float said = ImGui::GetItemRectMax().x;
    const float left = size.x - width - ImGui::GetStyle().WindowPadding.x;
    if (left > said + 20 * scale_) {
      ImGui::SameLine(left);
      ImGui::TextDisabled("%s", keys);
    }
  }
  ImGui::End();
}

void Panel::show_loading(const PanelInput& input) const {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float width = 300 * scale_;
  ImGui::SetNextWindowPos({0.5F * (size.x + static_cast<float>(covered())), 0.5F * size.y},
                          ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({width, 0});
  if (ImGui::Begin("loading", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs)) {
    ImGui::TextUnformatted(input.status.stage.c_str());
    ImGui::ProgressBar(static_cast<float>(input.status.fraction), {-1, 0});
  }
  ImGui::End();
}

void Panel::mark(Vec2d held, Vec2d mouse) const {
  const auto at = [](Vec2d p) { return ImVec2(static_cast<float>(p.x), static_cast<float>(p.y)); };
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddLine(at(held), at(mouse), IM_COL32(255, 255, 255, 160), 1.5F * scale_);
  list.AddCircleFilled(at(held), 4 * scale_, IM_COL32(255, 255, 255, 230));
  list.AddCircle(at(mouse), 7 * scale_, IM_COL32(255, 255, 255, 200), 0, 1.5F * scale_);
}

}  // namespace weft::viewer
