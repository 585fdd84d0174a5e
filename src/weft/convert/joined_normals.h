#pragma once

#include <vector>

#include "weft/convert/pieces.h"
#include "weft/param/square_map.h"
#include "weft/repair.h"

namespace weft {

/// Normals of a surface that was parted, which go on smoothly where its pieces meet.
class JoinedNormals {
 public:
  explicit JoinedNormals(const RepairedMesh& surface);

  /// Unit normals at the vertices of a disk that a piece was cut open to: sums over all triangles
  /// at the point, in whichever piece, whose vertex there faces within a right angle of its own.
  /// [D]
  [[nodiscard]] std::vector<Vec3d> of(const DiskMesh& disk, const Piece& piece) const;

 private:
  std::vector<Vec3d> normals_;  // [V] of the surface's mesh
};

}  // namespace weft
