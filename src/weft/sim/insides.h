#pragma once

#include <span>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/mesh/winding.h"
#include "weft/simulation.h"

namespace weft {

/// The triangles of an image's surface by the samples that stand for their classes; those with a
/// repeated corner left out.
std::vector<Triangle> joined_triangles(const GeometryImage& image);

/// A placed surface as what is inside of it is asked for.
class ClosedBody {
 public:
  /// @param image  its triangles; kept by reference, as are the positions [n x n] [m]
  ClosedBody(const GeometryImage& image, const Planes3& positions);
  /// Whether it has an inside at all; what follows needs it.
  [[nodiscard]] bool closed() const { return winding_.has_value(); }
  /// Takes the positions as they are now.
  void follow();
  /// Of each sample of a surface, mates too, whether the body winds around it. [n * n]
  void mark_inside(const Planes3& samples, ThreadTeam& team, std::vector<char>& inside) const;

 private:
  void put_corners(std::span<Corners> corners) const;

  const Planes3* positions_;
  std::vector<Triangle> triangles_;  // by samples that stand for their classes
  Box3d box_;
  std::optional<WindingNumbers> winding_;
};

/// Where a cloth begins among the bodies.
struct StartSides {
  std::vector<StartInside> inside;
  std::vector<char> kept_in;    ///< of each body: whether it keeps the cloth in
  std::vector<int> wrong_side;  ///< of each sample: the number, from 1, of a body that pushes it
                                ///< out; 0: of none [n * n]
};

/// @param containers  whether there can be any; else all that is inside is pushed out
StartSides find_start_sides(const SimulatedCloth& cloth, std::span<const PlacedBody> bodies,
                            bool containers, ThreadTeam& team);

/// What is told of it, in one line.
std::string start_inside_text(const StartInside& found);

}  // namespace weft
