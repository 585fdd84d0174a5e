#pragma once

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/kernel_table.h"
#include "weft/core/thread_team.h"

namespace weft {

/// Forces of all springs, elastic and damping, row by row from above, each spring worked out once:
/// what it does to rows below waits in a worker's lines until they are reached. Workers repeat the
/// springs that lead into their first rows, so every row is summed in the same order on any team.
class SpringRows {
 public:
  /// @param cloth  kept by reference
  SpringRows(const Cloth& cloth, const ThreadTeam& team);

  /// Where the springs are and where they were when the step began.
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
