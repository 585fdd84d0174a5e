#pragma once

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
  /// Looks at the bodies where they are. @pre `driven` has them there
  void set_up(ThreadTeam& team);
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
    std::vector<char> at_start, at_end;  // of the frame [n * n]
  };
  void look_at(std::size_t body, double gap, ThreadTeam& team);

  LoadedScene& loaded_;
  std::vector<Changing> changing_;
};

/// Says in one line how much of a body lies in itself; empty where nothing does.
std::string buried_text(const PlacedBody& body);

}  // namespace weft
