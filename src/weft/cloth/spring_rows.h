#pragma once

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Forces of all springs, elastic and damping, row by row from above. Each spring is evaluated
/// once: its force on a row below is kept in the worker's line buffers until that row is reached.
/// Workers repeat the springs that lead into their first rows, so every row is summed in the same
/// order on any team.
class SpringRows {
 public:
  /// @param cloth  kept by reference
  SpringRows(const Cloth& cloth, const ThreadTeam& team);

  /// Current positions, and positions at the start of the step.
  struct Motion {
    const Planes3 &position, &start;  ///< [n x n] [m]
    double time_step;                 ///< [s]
  };
  /// To be called by every worker before its first row.
  void begin(const Motion& motion, Worker& worker);
  /// Own part of the forces on the worker's next row; [n] each, valid until the next call [N].
  ConstRow3 row(const Motion& motion, int row, Worker& worker);

 private:
  [[nodiscard]] Row3 lines(const Worker& worker, int index);
  void add_row(const Motion& motion, int row, Worker& worker);
  [[nodiscard]] SpringRow springs(int direction, int row) const;

  const Cloth& cloth_;
  const KernelTable& kernels_;
  bool bends_ = false;  // whether there are second-neighbour springs
  Grid<float> lines_;
};

}  // namespace weft
