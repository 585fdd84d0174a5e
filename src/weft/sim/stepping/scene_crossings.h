#pragma once

#include <optional>
#include <string>
#include <vector>

#include "weft/collide/intersections.h"
#include "weft/scene.h"
#include "weft/sim/loading/load_scene.h"

namespace weft {

/// Counts what the surfaces of a scene cross; what that takes is made at its first use.
class SceneCrossings {
 public:
  /// All are kept by reference.
  SceneCrossings(const Scene& scene, const LoadedScene& loaded) : scene_(scene), loaded_(loaded) {}

  [[nodiscard]] IntersectionCounts count() { return check().count(); }
  /// Refuses cloths that begin in the same place.
  /// @param name  of the scene, for errors  @throws SceneError
  void refuse_cloths_in_one_place(const std::string& name);

 private:
  IntersectionCheck& check();

  const Scene& scene_;
  const LoadedScene& loaded_;
  std::vector<std::vector<Triangle>> triangles_;  // of cloths, then bodies
  std::optional<IntersectionCheck> check_;        // of what they and the ground cross
};

}  // namespace weft
