#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/sim/loading/load_scene.h"
#include "weft/sim/motion/buried_samples.h"

namespace weft {

/// Keeps track of what of a scene's bodies lies in themselves (PlacedBody::buried), frame by frame:
/// of what does so at the begin or the end of a frame the collider is told for all of it. Bodies
/// that keep a cloth in have no such parts.
class BuriedBodies {
 public:
  /// @param loaded  kept by reference; its bodies get their marks
  explicit BuriedBodies(LoadedScene& loaded) : loaded_(loaded) {}
  /// Looks at the bodies where they begin. @pre `driven` has them there
  void set_up(ThreadTeam& team);
  /// Looks at those that change their shape where they are, as a run is resumed. @pre as set_up
  void recheck(ThreadTeam& team);
  /// Begins a frame, at whose end `driven` has the bodies.
  void begin_frame(Collider& collider, ThreadTeam& team);
  /// Tells a new collider of the marks.
  void tell(Collider& collider) const;
  /// Number of samples of all bodies that lie in their body, mates counted once.
  [[nodiscard]] int count() const;

 private:
  /// A body that changes its shape.
  struct Changing {
    std::size_t body = 0;
    std::unique_ptr<BuriedSamples> samples;
    Planes3 begin;                         // positions at the begin of the run [m]
    std::vector<char> at_start, at_end{};  // of the frame [n * n]
  };
  void look_at(std::size_t body, ThreadTeam& team);
  /// Whether a body is where it began, up to a gap.
  [[nodiscard]] bool at_begin(const Changing& one, const Planes3& positions) const;

  LoadedScene& loaded_;
  double gap_ = HUGE_VAL;  // the smallest that a cloth keeps to bodies [m]
  std::vector<Changing> changing_;
};

/// Says in one line how much of a body lies in itself; empty where nothing does.
std::string buried_text(const PlacedBody& body);

}  // namespace weft
