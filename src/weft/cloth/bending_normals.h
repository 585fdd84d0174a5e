#pragma once

#include "weft/cloth/chart_rows.h"
#include "weft/cloth/cloth.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The rest-curvature term of bending: u = M x - r n, r = sqrt(B area) H0 along the normal
/// n = N / |N|, N the sum of the cross products of the edges around a particle. The derivative of n
/// is included, dn = (1 - n n^T) dN / |N|, so the forces are the gradient of an energy and conserve
/// angular momentum.
class BendingNormals {
 public:
  /// @param cloth  kept by reference
  explicit BendingNormals(const Cloth& cloth);

  /// u -= r n, where u holds M x summed over mates. To be called by every worker when all positions
  /// are in place; ends with a barrier. The positions are kept by reference.
  void subtract(const Planes3& position, Planes3& u, Worker& worker);
  /// u -= r dn, dn the change of the normals for a change of the positions of the last subtract.
  void subtract_change(const Planes3& change, Planes3& u, Worker& worker);
  /// Adds factor (r dn/dx)^T u to each sample's own part of a row, for the u of the last subtract
  /// or subtract_change.
  void add_row(float factor, int row, Planes3& out) const;

 private:
  void area_row(const Planes3& first, const Planes3& second, int row, Planes3& out) const;
  void add_row_part(float factor, int row, const ChartRow& part, Planes3& out) const;
  void share_areas(Planes3& areas, Worker& worker) const;
  void subtract_row(int row, Planes3& u);
  void subtract_change_row(int row, Planes3& u);
  void project_row(int row, const Planes3& u);

  const Cloth& cloth_;
  const Planes3* position_ = nullptr;
  Planes3 area_;     // N of the positions [m^2]
  Planes3 turn_;     // dN [m^2]
  Planes3 project_;  // r / |N| (1 - n n^T) u
  ChartRows rows_;
};

}  // namespace weft
