#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "apps/viewer/snapshot.h"
#include "weft/progress.h"
#include "weft/simulation.h"
#include "weft/threads.h"

namespace weft::viewer {

/// Source of what is shown: a simulation, a recorded run, or a surface that does not move. Used by
/// one thread.
class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;

  [[nodiscard]] const std::shared_ptr<const Subject>& subject() const { return subject_; }
  [[nodiscard]] virtual double frame_rate() const { return 60; }  ///< [1/s]
  [[nodiscard]] virtual int frame() const { return 0; }
  /// Advances by one frame. @return false at the end, where nothing changes  @throws SceneError
  /// when the simulation runs away, InputError when a recording cannot be read
  virtual bool advance() { return false; }
  /// Goes back to the start.
  virtual void reset() {}
  /// As of Simulation; without effect where nothing can be held.
  virtual void grab(std::size_t /*cloth*/, int /*sample*/) {}
  virtual void pull(Vec3d /*target*/) {}
  virtual void let_go() {}
  /// Fills the parts of a snapshot that this source knows.
  virtual void show(const Colouring& colouring, Snapshot& snapshot) const = 0;

 protected:
  std::shared_ptr<const Subject> subject_;
};

/// Parameters of sources.
struct SourceMaker {
  int threads = 1;
  InstructionSet instructions = best_instruction_set();
  Progress* progress = nullptr;
  SurfaceCache* surfaces = nullptr;
  std::uint64_t number = 0;  ///< of the next subject
};

/// Opens whatever a name stands for: a scene (.json), the folder of a run, a geometry image, a mesh
/// or builtin:NAME. @throws whatever loading it throws
std::unique_ptr<Source> open_source(const std::string& name, const SourceMaker& maker);
/// Simulates a scene, from the state of `before` where both scenes have the same cloths and bodies,
/// at the same places.
/// @param before  or null  @param kept  set to whether that state was kept
std::unique_ptr<Source> simulate_scene(const Scene& scene, const SourceMaker& maker,
                                       const Source* before, bool& kept);

}  // namespace weft::viewer
