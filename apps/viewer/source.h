#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "apps/viewer/snapshot.h"
#include "weft/progress.h"
#include "weft/simulation.h"
#include "weft/threads.h"

namespace weft::viewer {

/// Where what is shown comes from: a simulation, a recorded run, a surface that stands still. Used
/// by one thread.
class Source {
 public:
  Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  virtual ~Source() = default;

  [[nodiscard]] const std::shared_ptr<const Subject>& subject() const { return subject_; }
  [[nodiscard]] virtual double frame_rate() const { return 60; }  ///< [1/s]
  [[nodiscard]] virtual int frame() const { return 0; }
  /// Goes on by one frame. @return false at the end, where nothing changes  @throws SceneError when
  /// the simulation runs away, InputError when a recording cannot be read
  virtual bool advance() { return false; }
  /// Goes back to the start.
  virtual void reset() {}
  /// See Simulation; nothing where nothing can be held.
  virtual void grab(std::size_t /*cloth*/, int /*sample*/) {}
  virtual void pull(Vec3d /*target*/) {}
  virtual void let_go() {}
  /// Fills all of a snapshot that this knows.
  virtual void show(const Colouring& colouring, Snapshot& snapshot) const = 0;

 protected:
  std::shared_ptr<const Subject> subject_;
};

/// What sources are made with.
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
/// Goes on from `before` where the scenes have the same cloths and bodies, at the same places.
/// @param before  or null  @param kept  set to whether it goes on
std::unique_ptr<Source> simulate_scene(const Scene& scene, const SourceMaker& maker,
                                       const Source* before, bool& kept);

}  // namespace weft::viewer
