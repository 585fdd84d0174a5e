#pragma once

#include <vector>

#include "weft/collide/collider.h"
#include "weft/collide/moving_surface.h"
#include "weft/core/disjoint_sets.h"

namespace weft {

/// Translations of cloths as wholes in a step: the mean displacement of their points, where cloths
/// that are not far apart count as one. None where points do not move alike, and of what is
/// pinned.
class CommonMotion {
 public:
  void clear() { cloths_.clear(); }
  void add(const MovingCloth& cloth, const SurfaceGrid& grid);
  /// @param far_apart  distance beyond which cloths count as several, relative to the largest
  ///                   displacement of one
  void find(double far_apart);
  /// Whether any cloth moves as a whole.
  [[nodiscard]] bool any() const;
  /// Translation of a cloth. [m]
  [[nodiscard]] Vec3d of(std::size_t cloth) const { return translations_[cloth]; }

 private:
  void join_near(double distance);
  void share();

  /// Displacements of some points.
  struct Displacements {
    int count = 0;
    bool pinned = false;
    Vec3d sum;           // [m]
    double squares = 0;  // sum of squared lengths [m^2]
    Box3d box;           // of starts and ends
    void add(Vec3d start, Vec3d end);
    void add(const Displacements& others);
    [[nodiscard]] Vec3d common() const;
  };
  std::vector<Displacements> cloths_;
  std::vector<Vec3d> translations_;
  DisjointSets sets_;
};

}  // namespace weft
