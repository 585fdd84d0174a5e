#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/sim/loading/load_scene.h"
#include "weft/sim/motion/buried_samples.h"

namespace weft {

/// Keeps track of what of a scene's bodies lies in themselves, frame by frame, at the begin or the
/// end of each. Of a body that has changed its shape by more than a gap since the run began, the
/// collider is told (PlacedBody::buried): only such a body can have come to hold cloth between
/// sides that cross. Bodies that keep a cloth in have no such parts.
class BuriedBodies {
 public:
  /// @param loaded  kept by reference; its bodies get their marks
  explicit BuriedBodies(LoadedScene& loaded) : loaded_(loaded) {}
  /// Looks at the bodies where they begin. @pre `driven` has them there
  void set_up(ThreadTeam& team);
  /// Finds which bodies moved in the frames before that from which a run is resumed; moves
  /// `driven`.
  /// @param frame_ends  of these, in order [s]
  void note_moved_before(std::span<const double> frame_ends, ThreadTeam& team);
  /// Looks at those that change their shape where they are, as a run is resumed. @pre as set_up
  void recheck(ThreadTeam& team);
  /// Begins a frame, at whose end `driven` has the bodies.
  void begin_frame(Collider& collider, ThreadTeam& team);
  /// Tells a new collider of the marks.
  void tell(Collider& collider) const;
  /// Number of samples of all bodies that lie in their body, mates counted once.
  [[nodiscard]] int count() const;
  /// A line on each body of which something lies in itself.
  [[nodiscard]] std::vector<std::string> notes() const;

 private:
  /// A body that changes its shape.
  struct Changing {
    std::size_t body = 0;
    std::unique_ptr<BuriedSamples> samples;
    Planes3 begin;                         // positions at the begin of the run [m]
    std::vector<char> at_start, at_end{};  // of the frame [n * n]
    bool moved = false;                    // by more than a gap, in this frame or before
  };
  void look_at(std::size_t body, ThreadTeam& team);
  /// Notes which bodies `driven` has elsewhere than where they began.
  void note_moved();

  LoadedScene& loaded_;
  double gap_ = HUGE_VAL;  // the smallest that a cloth keeps to bodies [m]
  std::vector<Changing> changing_;
  std::vector<int> counts_;  // of each body, samples that lie in it
};

}  // namespace weft
