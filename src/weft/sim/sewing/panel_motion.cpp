#include "weft/sim/sewing/panel_motion.h"

#include <algorithm>

#include "weft/sim/sewing/panel_moves.h"

namespace weft {
namespace {

/// Rate at which velocities come to those that are wanted. Much higher, panels would be pressed
/// onto bodies and stick. [1/s]
constexpr double damping = 6;
/// Cloth that was stretched and slips free goes no faster than this; it would throw others about,
/// at 50 m/s where it was stretched by half. [m/s]
constexpr double fastest_of_panel = 2;
/// Rate at which panels come back to the height that they begin at. [1/s]
constexpr double hold_rate = 10;

}  // namespace

PanelMotion::PanelMotion(const Garment& garment, const Planes3& start)
    : garment_(garment), panels_(garment.panel_holds.size()) {
  for (int s = 0; s < start.size() * start.size(); ++s) {
    panel_of_.push_back(weft::panel_of(garment_.image.mates, s));
    Panel& panel = panels_[panel_of_.back()];
    panel.start_height += start.at(s).y;
    ++panel.size;
  }
  for (Panel& panel : panels_) panel.start_height /= std::max(1, panel.size);
}

void PanelMotion::begin_step() {
  for (Panel& panel : panels_) {
    panel.pull = {};
    panel.pulled = panel.led_by = 0;
    panel.led = 0;
  }
}

void PanelMotion::add_pull(int sample, bool led, Vec3d pull) {
  Panel& panel = panels_[panel_of_[sample]];
  panel.pull += pull;
  ++panel.pulled;
  if (!led) return;
  panel.led += pull.y;
  ++panel.led_by;
}

Vec3d PanelMotion::Panel::wanted() const {
  Vec3d velocity = (1.0 / std::max(1, pulled)) * pull;
  if (led_by > 0) velocity.y = led / led_by;
  return velocity;
}

void PanelMotion::carry(bool closing, double time_step, Planes3& velocity) const {
  const double kept = 1 / (1 + damping * time_step);
  for (int s = 0; s < velocity.size() * velocity.size(); ++s) {
    const Vec3d wanted = closing ? panels_[panel_of_[s]].wanted() : Vec3d{};
    const Vec3d rest = kept * (vec_cast<double>(velocity.at(s)) - wanted);
    velocity.set(s,
                 vec_cast<float>(wanted + std::min(1.0, fastest_of_panel / length(rest)) * rest));
  }
}

void PanelMotion::measure(const ClothState& state) {
  for (Panel& panel : panels_) panel.height = panel.rise = 0;
  for (int s = 0; s < state.position.size() * state.position.size(); ++s) {
    Panel& panel = panels_[panel_of_[s]];
    panel.height += state.position.at(s).y;
    panel.rise += state.velocity.at(s).y;
  }
  for (Panel& panel : panels_) {
    panel.height /= std::max(1, panel.size);
    panel.rise /= std::max(1, panel.size);
  }
}

void PanelMotion::hold(ClothState& state) {
  measure(state);
  for (int s = 0; s < state.position.size() * state.position.size(); ++s) {
    const Panel& panel = panels_[panel_of_[s]];
    const double missing = hold_rate * (panel.start_height - panel.height) - panel.rise;
    if (hold_of(s) == PanelHold::other_panels || missing <= 0) continue;
    Vec3f velocity = state.velocity.at(s);
    velocity.y += static_cast<float>(missing);
    state.velocity.set(s, velocity);
  }
}

}  // namespace weft
