#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "apps/viewer/command_queue.h"
#include "apps/viewer/snapshot.h"
#include "apps/viewer/source.h"

namespace weft::viewer {

/// Hands values from one thread that writes to one that reads, neither ever waiting for the other:
/// the reader gets the newest whole value, those in between are lost. Three values stay where they
/// are, so that what they hold is allocated once.
template <class T>
class TripleBuffer {
 public:
  /// Of the writer: what to fill before `publish`; holds what was published some time ago.
  [[nodiscard]] T& back() { return values_[back_]; }
  void publish() { back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & place; }

  /// Of the reader: the newest value that `update` has found.
  [[nodiscard]] const T& front() const { return values_[front_]; }
  /// @return whether front() is another value now
  bool update() {
    if ((middle_.load(std::memory_order_relaxed) & fresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & place;
    return true;
  }

 private:
  static constexpr unsigned place = 3, fresh = 4;
  std::array<T, 3> values_{};
  unsigned back_ = 0, front_ = 2;
  std::atomic<unsigned> middle_{1};
};

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
