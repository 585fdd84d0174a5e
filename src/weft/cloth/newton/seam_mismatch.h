#pragma once

#include <span>
#include <utility>
#include <vector>

#include "weft/cloth/newton/level_layout.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/cloth/newton/seams.h"

namespace weft {

/// The energy that seams of finer levels add to a coarse one. Where nodes of two charts do not
/// meet, interpolation gives copies of a particle different values, and the finer level takes their
/// mean. What that strains is no part of the charts' Galerkin products: a correction across one
/// chart, which costs nothing there, may pull another along its threads. Here each copy has the
/// energy (d, D d) / 2 of its difference d from the mean, with D the diagonal block of its own
/// part, so that the energy of a coarse correction is never much larger than its level knows.
class SeamMismatch {
 public:
  /// A level's layout and seams.
  struct Level {
    const LevelLayout& layout;
    const Seams& seams;
  };
  SeamMismatch() = default;
  /// Of a coarse level. @param finer  that of the fine level
  SeamMismatch(const SeamMismatch& finer, const Level& fine, const Level& coarse);
  [[nodiscard]] bool empty() const { return copies_.empty(); }

  /// Takes the blocks of the finer level, whose stencil has own parts. By one worker.
  void gather(const SeamMismatch& finer, const PlaneSet& fine_stencil);
  /// residual -= E value, by all workers, with barriers around.
  void subtract(const Workers& workers, const PaddedVectors& value, PaddedVectors& residual) const;
  /// Adds a bound of E, a block at each node, to the centres of a stencil, and takes it away again.
  /// By one worker.
  void join(PlaneSet& stencil);
  void part(PlaneSet& stencil) const;

  /// A block of E: between two nodes, which are first copies.
  struct Block {
    int row = 0, col = 0;
    const float* entries = nullptr;  ///< xx, xy, xz, yy, yz, zz
  };
  [[nodiscard]] int block_count() const { return static_cast<int>(columns_.size()); }
  [[nodiscard]] Block block(int index) const {
    return {nodes_[rows_[index]], nodes_[columns_[index]], &blocks_[index * block_entries]};
  }

 private:
  /// A node, and its weight in a copy's difference.
  using Part = std::pair<int, float>;
  struct Copy {
    int source = 0;  // a sample of the finer level, or one of its copies that have differences
    int first = 0, last = 0;  // in parts_
    int place = 0;            // of its first pair of parts, in places_
  };
  [[nodiscard]] std::span<const Part> parts(const Copy& copy) const {
    return std::span(parts_).subspan(copy.first, copy.last - copy.first);
  }
  void add(int source, const std::vector<Part>& difference);
  void find_pattern();
  void add_energy(const Copy& copy, const float* own);

  int inherited_ = 0;  // of the finer level: the first of the copies
  std::vector<Copy> copies_;
  std::vector<Part> parts_;          // nodes by their index in nodes_
  std::vector<float> own_;           // D of each copy
  std::vector<int> nodes_;           // ascending
  std::vector<int> starts_;          // of the rows of E, in columns_
  std::vector<int> rows_, columns_;  // of each block of E, by their index in nodes_
  std::vector<int> places_;          // of the blocks that each pair of a copy's parts is added to
  std::vector<float> blocks_, bounds_, kept_;
};

}  // namespace weft
