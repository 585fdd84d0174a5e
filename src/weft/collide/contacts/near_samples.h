#pragma once

#include <span>
#include <vector>

#include "weft/collide/contacts/contact_body.h"
#include "weft/collide/contacts/known_distances.h"

namespace weft {

/// A sample of a cloth near a body, with all of its contact that the start of a step decides.
struct alignas(64) NearSample {
  Vec3f start;                 ///< [m]
  int triangle = -1;           ///< the closest one at the start; -1: none is within reach
  Vec3f normal;                ///< see PlaceBefore
  float gap = 0;               ///< see PlaceBefore [m]
  Vec3f displacement;          ///< of the surface in the step [m]
  float along = 0;             ///< the same along the normal [m]
  float offset = 0, lift = 0;  ///< of the contact [m]
  int motion = 0;              ///< of the body, to which the displacement belongs; 0: none
  bool astray = false;         ///< it starts on the wrong side of the body
};

/// Finds the samples of one cloth that may touch one body in a step. Where a body that stands still
/// leaves so little room that a sample is near two of its sides, as in an armpit, both are found:
/// with the closest one alone, a sample would go to and fro between them. A step asks twice, before
/// and after its solve: what the first search found at the start is known to the second one.
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
  /// A sample near the body in the last search, or null.
  [[nodiscard]] const NearSample* find(int row, int col) const {
    return reach_(row, col) > 0 ? &samples_[place_[row * grid_.size() + col]] : nullptr;
  }
  /// Adds the contacts of a row's samples with the body that come near it.
  void add_contact(const MovingCloth& cloth, const ContactBody& body, int row, int col,
                   std::vector<Contact>& out) const;
  /// Accepts a motion: the body stays at its end.
  void arrive(int motion) { known_.arrive(motion); }
  /// The smallest signed distance of a sample to the body, < 0 on the wrong side; infinite where
  /// none is nearer than `reach`. [m]
  double smallest_gap(const Planes3& positions, const ContactBody& body, double reach,
                      ThreadTeam& team);

 private:
  struct Search;
  class Tile;
  /// Adds the contact of a sample with the side opposite to the closest, if it comes near that.
  void add_opposite(const NearSample& near, Vec3d displacement, const ContactBody& body, int sample,
                    std::vector<Contact>& out) const;
  template <class Visit>
  void for_tiles(const Worker& worker, const Visit& visit) const;
  void choose_row(const Search& search, int row);
  void make_room();
  void make_scratch(const ThreadTeam& team);
  [[nodiscard]] double smallest_of(const NearestTile& asked, const NearestPoints& found,
                                   const ContactBody& body) const;

  const SurfaceGrid& grid_;
  KeptGap kept_;
  bool keeps_in_;
  KnownDistances known_;
  Grid<float> reach_;  // of the last search, 0: the sample is far, or no representative [m]
  std::vector<NearSample> samples_;  // that were near in some search
  std::vector<int> opposite_;  // of each a triangle of the side opposite to the closest; -1: none
  std::vector<int> place_;     // [n * n] of a sample among them; -1: it never was near
  std::vector<int> fresh_;     // [n + 1] places of rows' samples that are near for the first time
  int placement_ = 0;          // of the body in the last search
  /// Whether the last search looked for opposite sides: not of a body that moves, on which cloth
  /// does not come to rest anyway, and not while seams are sewn, which need cloth that gives way.
  bool knows_opposites_ = false;
  std::vector<KnownDistances::Scratch> scratch_;  // of each worker
  std::vector<double> tile_gaps_;
};

}  // namespace weft
