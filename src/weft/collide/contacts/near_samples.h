#pragma once

#include <span>
#include <vector>

#include "weft/collide/contacts/contact_body.h"
#include "weft/collide/contacts/known_distances.h"

namespace weft {

/// A sample of a cloth near a body, with all of its contact that the start of a step decides.
struct NearSample {
  int sample = 0;
  int triangle = -1;  ///< the closest one at the start; -1: none is within reach
  Vec3f start;        ///< [m]
  int motion = 0;     ///< of the body in the step to which `along` and the contact belong; 0: none
  bool astray = false;  ///< it starts on the wrong side of the body
  PlaceBefore before;
  double along = 0;  ///< displacement of the surface along the normal [m]
  Contact contact;   ///< if the sample comes near
};

/// Finds the samples of one cloth that may touch one body in a step. A step asks twice, before and
/// after its solve: what the first search found at the start is known to the second one.
class NearSamples {
 public:
  /// @param grid  of the cloth, kept by reference
  NearSamples(const SurfaceGrid& grid, const KeptGap& kept, bool keeps_in);

  /// Samples that may start on the wrong side of the body.
  struct Doubts {
    std::span<const char> deep;       ///< [n * n] not 0: it may; empty: none may
    double farthest_exit = HUGE_VAL;  ///< see ClothPoint::farthest [m]
  };
  void find(const MovingCloth& cloth, const ContactBody& body, const Doubts& doubts,
            ThreadTeam& team);
  [[nodiscard]] std::span<const NearSample> all() const { return now_.samples; }
  /// A sample, or null where it is not among them.
  [[nodiscard]] const NearSample* find(int row, int col) const { return now_.find(row, col); }
  /// Accepts a motion: the body stays at its end.
  void arrive(int motion) { known_.arrive(motion); }
  /// The smallest signed distance of a sample to the body, < 0 on the wrong side; infinite where
  /// none is nearer than `reach`. [m]
  double smallest_gap(const Planes3& positions, const ContactBody& body, double reach,
                      ThreadTeam& team);

 private:
  struct Search;
  class Tile;
  /// What a search found.
  struct Found {
    std::vector<NearSample> samples;  // row by row
    std::vector<int> first;           // [n + 1] index of each row's first one
    std::vector<int> place;           // [n * n] of a sample in its row; -1: it is not among them
    /// A sample, or null where it is not among them.
    [[nodiscard]] const NearSample* find(int row, int col) const {
      const int at = place[row * (static_cast<int>(first.size()) - 1) + col];
      return at < 0 ? nullptr : &samples[first[row] + at];
    }
  };
  template <class Visit>
  void for_tiles(ThreadTeam& team, const Visit& visit) const;
  void number_row(const Search& search, int row);
  [[nodiscard]] double gap_of_tile(const Planes3& positions, const ContactBody& body, double reach,
                                   int first_row, int first_col) const;
  [[nodiscard]] bool take_over(const Search& search, NearSample& to) const;

  const SurfaceGrid& grid_;
  KeptGap kept_;
  bool keeps_in_;
  KnownDistances known_;
  Grid<float> reach_;  // of this search, 0: the sample is far [m]
  Found now_, before_;
  int placement_ = 0;                             // of the body in the last search
  std::vector<KnownDistances::Scratch> scratch_;  // of each worker
  std::vector<double> tile_gaps_;
};

}  // namespace weft
