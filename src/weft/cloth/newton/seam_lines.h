#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/newton/block_level.h"
#include "weft/cloth/newton/seams.h"
#include "weft/cloth/newton/spring_hessian.h"

namespace weft {

/// Sums what holds the particles of a finest level's seams over their copies, for the lines of
/// their first copies (see HeldLineMatrix); on the lines of the others they are fixed. Springs that
/// such a line has itself are left out, not subtracted, so that nothing cancels.
class SeamLines {
 public:
  SeamLines() = default;
  /// @param joined  groups of border edges whose springs are summed for lines, see Seams::edges
  SeamLines(const Seams& seams, std::span<const std::vector<BorderEdge>> joined);

  /// Changes `held_rows` and `held_cols`, which have own parts. @param springs  not joined yet
  void hold(const SpringHessian& springs, BlockLevel& level, const Workers& workers) const;

 private:
  /// Of a copy that is not the first: its own part of one direction, without that direction's
  /// springs, and those of them that the line does not have.
  struct Part {
    int sample = 0;
    bool of_rows = true;
    std::array<BorderEdge, 2> springs{};
    int count = 0;
  };
  /// For the row or the column of a first copy.
  struct Line {
    int first = 0;  ///< sample
    bool along_row = true;
    int begin = 0, end = 0;  ///< in parts_
  };
  static Part part_of(int size, int sample, std::span<const BorderEdge> joined);
  void hold_line(const Line& line, const SpringHessian& springs, BlockLevel& level) const;

  std::vector<Line> lines_;  // both of each class in turn
  std::vector<Part> parts_;
};

}  // namespace weft
