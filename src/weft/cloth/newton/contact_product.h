#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/cloth/kernels/row_pointers.h"
#include "weft/cloth/newton/padded_planes.h"
#include "weft/contact.h"
#include "weft/core/contact_uses.h"
#include "weft/core/four.h"
#include "weft/core/thread_team.h"

namespace weft {

/// The contacts of a linear system as springs, packed for fast products: a contact between points p
/// with displacement m = sum of weights x has the load (k - g) (n . m) n + g m, of which each of
/// its samples gets its weight's part. A class of mates is one particle: the load on one of its
/// samples is shared evenly among all.
class ContactProduct {
 public:
  /// A contact's spring.
  struct Spring {
    std::array<int, 4> samples{};    ///< row * n + col
    std::array<float, 4> weights{};  ///< those below 0 are of the second cloth
    Vec3f normal;
    float stiffness = 0, grip = 0;  ///< along the normal and along the surface [N/m]
    std::array<int, 2> cloths{};    ///< of weights above 0 and below
  };
  explicit ContactProduct(std::span<const Cloth* const> cloths);

  // Call clear, add any number of times and finish before the rest.
  void clear();
  /// Springs of the same cloths that follow one another are fastest.
  void add(const Spring& spring);
  void finish();
  [[nodiscard]] int size() const { return count_; }
  /// Whether a row of a cloth has contacts.
  [[nodiscard]] bool touches(std::size_t cloth, int row) const {
    return sides_[cloth].row_starts[row] < sides_[cloth].row_starts[row + 1];
  }

  /// A vector at each sample of every cloth.
  using Fields = std::span<const PaddedVectors* const>;
  /// Computes the loads of a field, by all workers; ends with a barrier.
  void multiply(Fields field, Worker& worker);
  /// Sets a load, in the order of add. @param index  of the spring
  void set_load(int index, Vec3f load) { loads_[slots_[index]] = Four{load.x, load.y, load.z, 0}; }
  /// out += factor times each sample's own part of the loads.
  void add_row(std::size_t cloth, int row, float factor, Row3 out) const;

  /// Symmetric blocks of a sample: xx, xy, xz, yy, yz, zz.
  struct Blocks {
    std::array<float, 6> whole{};  ///< together at least the springs' matrix
    std::array<float, 6> lines{};  ///< of which the smoother takes
  };
  /// Calls visit(col, blocks) for the touched samples of a row. Of a spring with weights w,
  /// w w^T is at most sum |w| times the diagonal of |w|, so a sample gets sum |w| |w_i| times
  /// k n n^T + g (1 - n n^T).
  template <class Visit>
  void for_blocks(std::size_t cloth, int row, const Visit& visit) const {
    const Side& side = sides_[cloth];
    for (int at = side.row_starts[row]; at < side.row_starts[row + 1]; ++at)
      visit(side.uses.samples()[at] - row * side.size, blocks_of(side, at));
  }

 private:
  /// Four contacts, side by side.
  struct Quad {
    std::array<std::array<std::ptrdiff_t, 4>, 4> places;  // [sample][contact], in a plane
    std::array<std::array<unsigned char, 4>, 4> second;   // whether it is of the second cloth
    std::array<Four, 4> weights;
    Four x, y, z;          // normals
    Four stiffness, grip;  // k - g, g
  };
  /// Quads of the same two cloths.
  struct Group {
    std::array<int, 2> cloths{};
    int first = 0, last = 0;
  };
  /// The contacts of a cloth's samples.
  struct Side {
    int size = 0;
    std::vector<int> class_at;    // [n n] class of each sample, -1 where it has no mates
    ContactUses uses;             // with slots as contacts
    std::vector<int> row_starts;  // [n + 1] into uses.samples()
    explicit Side(const Cloth& cloth);
  };
  void add_use(int cloth, int sample, int slot, float weight);
  void multiply(const Group& group, Range quads, Fields field);
  [[nodiscard]] Blocks blocks_of(const Side& side, int at) const;

  std::vector<const Cloth*> cloths_;
  std::vector<Side> sides_;  // of each cloth
  std::vector<Quad> quads_;
  std::vector<Group> groups_;
  std::vector<Four> loads_;  // [4 quads] x, y, z, 0
  std::vector<int> slots_;   // of each spring: its index in loads
  int count_ = 0;
};

}  // namespace weft
