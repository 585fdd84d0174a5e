#pragma once

#include <string>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/scene.h"
#include "weft/sim/loading/load_scene.h"
#include "weft/sim/stepping/adaptive_substeps.h"

namespace weft {

/// Shortens steps in which bodies approach cloth by more than they can push it.
class ApproachLimit {
 public:
  /// The step that bodies have been moved for.
  struct Step {
    const Collider& collider;  ///< with the bodies' motion
    double length = 0;         ///< [s]
    int frame = 0;
  };

  /// All are kept by reference.
  ApproachLimit(const Scene& scene, const std::string& name, const LoadedScene& loaded)
      : scene_(scene), name_(name), loaded_(loaded) {}
  /// @pre the surfaces are loaded
  void set_up();

  /// Number of steps, a power of 2, that moving bodies require of a substep.
  [[nodiscard]] int subdivisions(const Step& substep);
  /// The level that moving bodies require of the rest of a substep where they are faster in a step
  /// than over the whole of it, as at a key of their path; -1 where the step is short enough.
  /// @param subdivisions  of the substep by the length of this step
  [[nodiscard]] int required_level(const Step& step, int subdivisions);

  /// What is to be said of bodies that may prove too fast; empty: nothing.
  [[nodiscard]] std::string caution(double substep_time) const;

 private:
  [[nodiscard]] double wanted_parts(const Step& step);
  /// Refuses bodies too fast for so many subdivisions of a substep. @throws SceneError
  void check_speed(double subdivisions, int frame) const;

  const Scene& scene_;
  const std::string& name_;
  const LoadedScene& loaded_;
  double gap_ = 0;    // the smallest of all cloths [m]
  ClothReach reach_;  // of one cloth in a substep
};

}  // namespace weft
