#include "apps/viewer/viewer.h"

#include <algorithm>
#include <chrono>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/viewer/controls.h"
#include "apps/viewer/detail.h"
#include "apps/viewer/panel.h"
#include "apps/viewer/panel_parts.h"
#include "apps/viewer/report.h"
#include "apps/viewer/scene_view.h"
#include "apps/viewer/simulator.h"
#include "weft/files.h"
#include "weft/window_canvas.h"

namespace weft::viewer {
namespace {

using Clock = std::chrono::steady_clock;

/// Longest wait for events, so that a request to stop is noticed [s].
constexpr double longest_wait = 0.1;
/// Shortest time between two pictures [s].
constexpr double min_frame = 1.0 / 60;
/// Pictures drawn after the last event, as the panel takes some to react.
constexpr int settling_pictures = 3;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Position of the mouse at a press or turn of the wheel; far away for other events.
Vec2d place_of(const Event& event) {
  if (const auto* pressed = std::get_if<MousePressed>(&event)) return pressed->at;
  if (const auto* wheel = std::get_if<WheelTurned>(&event)) return wheel->at;
  return {HUGE_VAL, HUGE_VAL};
}

class Viewer {
 public:
  explicit Viewer(const ViewerOptions& options)
      : options_(options),
        window_(static_cast<int>(options.width), options.height, "weft"),
        context_(window_.handle(), window_.scale()),
        panel_(window_.scale()),
        controls_(!options.paused),
        simulator_(
            {options.threads, options.instructions, options.paused, options.until, Window::wake}) {
    simulator_.push(Open{options.subject});
  }

  nlohmann::ordered_json run() {
    while (!window_.closes()) {
      turn();
      options_.check();
      if (is_done()) window_.close();
    }
    if (!options_.screenshot.empty()) {
      detail_.ask_for_fine();
      draw();
      save(options_.screenshot);
    }
    return tell();
  }

 private:
  /// Whether everything requested was shown, as far as it can be.
  [[nodiscard]] bool is_done() const {
    const Snapshot& snapshot = simulator_.snapshot();
    const bool is_there = !snapshot.running && snapshot.frame == options_.until;
    return (options_.until > 0 && (is_there || !status_.error.empty())) ||
           (options_.frames > 0 && shown_ >= options_.frames);
  }

  /// Waits for events, handles them, and draws where anything changed.
  void turn() {
    const std::vector<Event> events = window_.wait(waiting());
    if (!events.empty()) unsettled_ = settling_pictures;
    follow_size();
    for (const Event& event : events)
      controls_.handle(event, simulator_.snapshot(), camera_, panel_.takes_mouse(place_of(event)));
    fulfil(controls_.take_wishes());
    if (simulator_.update()) look_at_new();
    const Status status = simulator_.status();
    if (status.stage != status_.stage || status.fraction != status_.fraction ||
        status.message != status_.message || status.error != status_.error)
      unsettled_ = std::max(unsettled_, 1);
    // The bottom line shows the latest message.
    if (status.message != status_.message) note_.clear();
    status_ = status;
    if (detail_.wants_finer(seconds())) unsettled_ = std::max(unsettled_, 1);
    if (unsettled_ == 0 || window_.pixels().x < 1) return;
    --unsettled_;
    last_picture_ = Clock::now();
    draw();
    window_.show();
    detail_.end(milliseconds_since(last_picture_) / 1000);
    ++report_.frames;
    const bool loaded = simulator_.snapshot().subject != nullptr && status_.stage.empty();
    if (loaded || !status_.error.empty()) ++shown_;
    write_status();
  }

  [[nodiscard]] double waiting() const {
    if (unsettled_ == 0 && options_.frames == 0) return longest_wait;
    return std::max(0.0, min_frame - milliseconds_since(last_picture_) / 1000);
  }

  void follow_size() {
    const Vec2d size = window_.size();
    const int width = static_cast<int>(size.x), height = static_cast<int>(size.y);
    if (width != report_.width || height != report_.height || options_.frames > 0)
      unsettled_ = std::max(unsettled_, 1);
    report_.width = width;
    report_.height = height;
    camera_.resize(width, height, panel_.covered());
  }

  void look_at_new() {
    unsettled_ = std::max(unsettled_, 1);
    const Snapshot& snapshot = simulator_.snapshot();
    panel_.remember(snapshot);
    if (snapshot.subject->number == subject_) return;
    subject_ = snapshot.subject->number;
    window_.set_title("weft: " + snapshot.subject->name);
    if (snapshot.subject->frames_anew) camera_.frame(box_to_frame(snapshot));
  }

  void fulfil(const Wishes& wishes) {
    for (const Command& command : wishes.commands) simulator_.push(command);
    if (wishes.frame && simulator_.snapshot().subject)
      camera_.frame(box_to_frame(simulator_.snapshot()));
    if (wishes.toggle_panel) panel_.toggle();
    if (wishes.toggle_image) panel_.toggle_image();
    takes_picture_ = takes_picture_ || wishes.picture;
    takes_window_ = takes_window_ || wishes.whole_window;
    if (wishes.close) window_.close();
  }

  void draw() {
    const Snapshot& snapshot = simulator_.snapshot();
    const bool is_new = snapshot.number != drawn_;
    const Clock::time_point start = Clock::now();
    draw_scene(snapshot, is_new);
    double work = milliseconds_since(start);
    if (takes_picture_) save(next_picture(options_.folder));
    const Clock::time_point panel = Clock::now();
    draw_panel(snapshot);
    work += milliseconds_since(panel);
    if (is_new && snapshot.subject) report_.draw.add(work);
    drawn_ = snapshot.number;
    if (takes_window_) save(next_picture(options_.folder));
    takes_picture_ = takes_window_ = false;
  }

  void draw_scene(const Snapshot& snapshot, bool is_new) {
    const Camera camera = camera_.camera();
    if (takes_picture_ || takes_window_) detail_.ask_for_fine();
    detail_.begin(is_new || camera.eye != seen_from_.eye || camera.target != seen_from_.target,
                  seconds());
    seen_from_ = camera;
    DrawnScene scene = drawn_scene(snapshot, camera);
    scene.keep_light = detail_.keeps_light();
    const Vec2d pixels = window_.pixels();
    canvas_.paint(scene, {static_cast<int>(pixels.x), static_cast<int>(pixels.y)}, detail_.pixel());
    if (panel_.shows_image() && is_new && !snapshot.cloths.empty())
      image_ = canvas_.load_image(snapshot.cloths[0]);
  }

  [[nodiscard]] double seconds() const { return milliseconds_since(start_) / 1000; }

  void draw_panel(const Snapshot& snapshot) {
    PanelContext::begin();
    if (const auto& held = controls_.held(); held && held->cloth < snapshot.cloths.size())
      panel_.mark(camera_.pixel_of(vec_cast<double>(snapshot.cloths[held->cloth].at(held->sample))),
                  controls_.mouse());
    const Status shown = note_.empty() || !status_.error.empty() ? status_ : noted();
    fulfil(panel_.show({snapshot, shown, image_, report_.draw.median()}, controls_));
    PanelContext::draw();
  }

  [[nodiscard]] Status noted() const {
    Status status = status_;
    status.message = note_;
    return status;
  }

  /// Writes the window's buffer as a picture. Errors are shown in the window, or thrown for the
  /// picture at the end.
  void save(const std::filesystem::path& path) {
    const Vec2d pixels = window_.pixels();
    const bool at_the_end = path == options_.screenshot;
    try {
      write_png(path, WindowCanvas::read({static_cast<int>(pixels.x), static_cast<int>(pixels.y)}));
      report_.outputs.push_back(path.string());
      note_ = "wrote " + path.string();
      options_.say("wrote   " + path.string());
    } catch (const std::exception& error) {
      if (at_the_end) throw;
      note_ = error.what();
    }
    unsettled_ = std::max(unsettled_, 1);
  }

  [[nodiscard]] nlohmann::ordered_json tell() const {
    const Snapshot& snapshot = simulator_.snapshot();
    Vec2d middle;
    if (!snapshot.cloths.empty()) {
      const int n = snapshot.cloths[0].size();
      middle = camera_.pixel_of(vec_cast<double>(snapshot.cloths[0].at(n / 2, n / 2)));
    }
    return to_json(report_, snapshot, status_, middle);
  }

  void write_status() const {
    if (options_.status_file.empty()) return;
    write_file(options_.status_file, [&](std::ostream& out) {
      out << tell().dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    });
  }

  const ViewerOptions& options_;
  Window window_;
  PanelContext context_;
  WindowCanvas canvas_;
  Detail detail_;
  Camera seen_from_;    // of the last picture
  unsigned image_ = 0;  // the texture of the geometry image
  Panel panel_;
  Controls controls_;
  OrbitCamera camera_;
  WindowReport report_;
  Status status_;
  std::string note_;  // of the window itself, for the line at the bottom
  std::uint64_t subject_ = 0, drawn_ = 0;
  int unsettled_ = settling_pictures;
  int shown_ = 0;  // pictures of the subject, or of why there is none
  bool takes_picture_ = false, takes_window_ = false;
  Clock::time_point last_picture_{};
  const Clock::time_point start_ = Clock::now();
  Simulator simulator_;  // last: its thread wakes the window
};

}  // namespace

nlohmann::ordered_json run_viewer(const ViewerOptions& options) { return Viewer(options).run(); }

}  // namespace weft::viewer
