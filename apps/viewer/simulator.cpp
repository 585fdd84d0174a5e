#include "apps/viewer/simulator.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "weft/drape_scene.h"
#include "weft/error.h"

namespace weft::viewer {
namespace {

/// A visitor for std::visit: one call for each alternative of a variant.
template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// Longest sleep of the thread when there is nothing to do.
constexpr std::chrono::seconds rest{1};
/// Weight of the last frame in the averaged speed.
constexpr double renewal = 0.1;

}  // namespace

Simulator::Simulator(SimulatorOptions options)
    : options_(std::move(options)), running_(!options_.paused) {
  thread_ = std::thread([this] { run(); });
}

Simulator::~Simulator() {
  queue_.stop();
  thread_.join();
}

Status Simulator::status() const {
  const std::scoped_lock lock(status_mutex_);
  return status_;
}

bool Simulator::runs() const {
  return source_ && source_->subject()->plays && !stopped_by_error_ && (running_ || steps_ > 0);
}

void Simulator::run() noexcept {
  while (!queue_.stopped()) {
    obey_all();
    if (runs()) attempt([this] { advance(); });
    if (changed_) attempt([this] { publish(); });
    queue_.wait_until(runs() ? due_ : Clock::now() + rest);
  }
}

void Simulator::obey_all() {
  queue_.take(commands_);
  for (const Command& command : commands_) attempt([&] { obey(command); });
}

void Simulator::attempt(const std::function<void()>& action) noexcept {
  try {
    action();
  } catch (const Interrupted&) {
    // Another command replaces the work, or the window closes.
  } catch (const std::exception& error) {
    complain(error.what());
  }
  if (!loading_) return;
  loading_ = false;
  const std::scoped_lock lock(status_mutex_);
  status_.stage.clear();
}

void Simulator::obey(const Command& command) {
  changed_ = true;
  std::visit(Overloaded{[this](const Play& asked) {
                          running_ = asked.running;
                          last_ = {};
                        },
                        [this](const StepOnce&) {
                          running_ = false;
                          ++steps_;
                        },
                        [this](const Reset&) {
                          if (source_) source_->reset();
                          stopped_by_error_ = false;
                          tell("back at the start");
                        },
                        [this](const Grab& asked) {
                          if (source_) source_->grab(asked.cloth, asked.sample);
                        },
                        [this](const Pull& asked) {
                          if (source_) source_->pull(asked.target);
                        },
                        [this](const LetGo&) {
                          if (source_) source_->let_go();
                        },
                        [this](const Open& asked) { open(asked.subject); },
                        [this](const DrapeOver& asked) { drape_over(asked.body); },
                        [this](const Change& asked) { change(asked); },
                        [this](const Recolour& asked) { colouring_ = asked.colouring; }},
             command);
}

SourceMaker Simulator::maker() {
  loading_ = true;
  return {options_.threads, options_.instructions, this, &surface_cache_, ++subject_number_};
}

void Simulator::open(const std::string& subject) {
  surface_cache_.clear();
  update("open", 0);
  std::unique_ptr<Source> opened = open_source(subject, maker());
  original_ = opened->subject()->scene;
  show_from(std::move(opened));
  tell("opened " + std::filesystem::path(subject).filename().string());
}

void Simulator::drape_over(const std::string& body) {
  if (!source_) return;
  if (body.empty() && original_) return change({*original_, "as it was opened"});
  DrapeOptions options;
  std::string cloth = "builtin:sheet";
  Scene scene;
  if (source_->subject()->scene) {
    scene = *source_->subject()->scene;
    cloth = scene.cloths[0].surface.name;
    options.cloth_size = scene.cloths[0].size;
    options.material = scene.cloths[0].material;
    options.friction = scene.cloths[0].friction;
    options.files = scene.files;
  }
  const Scene made = make_drape_scene(cloth, body, options);
  scene.cloths = made.cloths;
  scene.bodies = made.bodies;
  scene.ground = made.ground;
  bool kept = false;
  show_from(simulate_scene(scene, maker(), source_.get(), kept));
  if (!original_) original_ = scene;
  tell(fmt::format("{} over {}, from the start", cloth, body));
}

void Simulator::change(const Change& asked) {
  if (!source_) return;
  bool kept = false;
  show_from(simulate_scene(asked.scene, maker(), source_.get(), kept));
  tell(asked.what + (kept ? "; the cloth goes on as it is" : "; from the start"));
}

void Simulator::show_from(std::unique_ptr<Source> source) {
  source_ = std::move(source);
  stopped_by_error_ = false;
  speed_ = 0;
  last_ = {};
}

void Simulator::advance() {
  steps_ = std::max(0, steps_ - 1);
  const bool went_on = source_->advance();
  const bool is_there = options_.until > 0 && source_->frame() == options_.until;
  if (!went_on || is_there) running_ = false;
  changed_ = true;
  pace();
}

void Simulator::pace() {
  const Clock::time_point now = Clock::now();
  const std::chrono::duration<double> frame(1 / source_->frame_rate());
  if (last_ != Clock::time_point{}) {
    const double speed = frame / std::max(std::chrono::duration<double>(now - last_), frame / 1.05);
    speed_ = speed_ > 0 ? speed_ + renewal * (std::min(speed, 1.0) - speed_) : std::min(speed, 1.0);
  }
  last_ = now;
  // Missed time is not caught up with.
  due_ = std::max(due_ + std::chrono::duration_cast<Clock::duration>(frame), now);
}

void Simulator::publish() {
  changed_ = false;
  if (source_) {
    Snapshot& next = snapshots_.back();
    source_->show(colouring_, next);
    next.number = ++snapshot_number_;
    next.subject = source_->subject();
    next.colouring = colouring_;
    next.running = running_ && !stopped_by_error_;
    next.speed = next.running ? speed_ : 0;
    snapshots_.publish();
  }
  options_.wake();
}

void Simulator::update(std::string_view stage, double fraction) {
  // Other commands interrupt loading only: a frame is finished unless the window closes.
  if (queue_.stopped() || (loading_ && queue_.is_overtaken())) throw Interrupted();
  if (!loading_) return;
  {
    const std::scoped_lock lock(status_mutex_);
    status_.stage = stage;
    status_.fraction = fraction;
  }
  options_.wake();
}

void Simulator::tell(const std::string& message) {
  const std::scoped_lock lock(status_mutex_);
  status_.message = message;
  status_.error.clear();
}

void Simulator::complain(const std::string& error) {
  stopped_by_error_ = stopped_by_error_ || !loading_;
  changed_ = true;
  const std::scoped_lock lock(status_mutex_);
  status_.error = error;
}

}  // namespace weft::viewer
