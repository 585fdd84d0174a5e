#pragma once

#include <algorithm>

#include "weft/cloth/baselines/multigrid/preconditioner_level.h"
#include "weft/cloth/neighbours.h"
#include "weft/core/instruction_set.h"

namespace weft::testing {

/// Own part of b - A x of a filter level. @param b  own part too
inline Planes3 filter_residual(const FilterLevel& level, const Planes3& b, const Planes3& x) {
  const int n = level.size();
  Planes3 out(n);
  for (int r = 0; r < n; ++r)
    kernels_for(InstructionSet::baseline)
        .apply(n, level.operator_row(r),
               {row_of(x, std::max(0, r - 1)), row_of(x, r), row_of(x, std::min(n - 1, r + 1))},
               row_of(out, r));
  for (int s = 0; s < n * n; ++s) out.set(s, out.at(s) + b.at(s));
  return out;
}

}  // namespace weft::testing
