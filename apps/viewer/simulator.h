#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "apps/viewer/command_queue.h"
#include "apps/viewer/snapshot.h"
#include "apps/viewer/source.h"
#include "apps/viewer/triple_buffer.h"

namespace weft::viewer {

struct SimulatorOptions {
  int threads = 1;
  InstructionSet instructions = best_instruction_set();
  bool paused = false;
  int until = 0;  ///< pauses at this frame; 0: never
  /// Called by the simulating thread when there is something new to see.
  std::function<void()> wake = [] {};
};

/// Runs a source in a thread of its own, so that loading and stepping never make the window wait:
/// commands go in, snapshots come out. It runs in real time, or as fast as it can where that is
/// slower.
class Simulator : private Progress {
 public:
  explicit Simulator(SimulatorOptions options);
  ~Simulator() override;

  /// Sends a command, from any thread.
  void push(Command command) { queue_.push(std::move(command)); }
  [[nodiscard]] Status status() const;

  // For the window's thread only.
  /// @return whether there is a newer snapshot
  bool update() { return snapshots_.update(); }
  /// The newest snapshot that `update` has found; without a subject until the first is there.
  [[nodiscard]] const Snapshot& snapshot() const { return snapshots_.front(); }

 private:
  using Clock = std::chrono::steady_clock;
  void run() noexcept;
  void obey_all();
  void obey(const Command& command);
  void open(const std::string& subject);
  void drape_over(const std::string& body);
  void change(const Change& asked);
  void show_from(std::unique_ptr<Source> source);
  void advance();
  void pace();
  void publish();
  void update(std::string_view stage, double fraction) override;
  void tell(const std::string& message);
  void complain(const std::string& error);
  [[nodiscard]] SourceMaker maker();
  [[nodiscard]] bool runs() const;
  /// Calls an action; what it throws becomes the error that the window shows.
  void attempt(const std::function<void()>& action) noexcept;

  SimulatorOptions options_;
  CommandQueue queue_;
  TripleBuffer<Snapshot> snapshots_;
  mutable std::mutex status_mutex_;
  Status status_;

  // Of the simulating thread alone.
  SurfaceCache surface_cache_;
  std::unique_ptr<Source> source_;
  std::optional<Scene> original_;  // as it was opened
  std::vector<Command> commands_;
  Colouring colouring_;
  bool running_ = true, stopped_by_error_ = false, changed_ = false;
  bool loading_ = false;
  int steps_ = 0;  // to be made while paused
  double speed_ = 0;
  Clock::time_point due_{}, last_{};
  std::uint64_t snapshot_number_ = 0, subject_number_ = 0;
  std::thread thread_;
};

}  // namespace weft::viewer
