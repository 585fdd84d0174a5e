#pragma once

#include <vector>

#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/contact_body.h"
#include "weft/contact.h"

namespace weft {

/// Per sample of a cloth, the number of the closed body on whose wrong side it is, or 0.
using InsideMarks = std::vector<int>;

/// Finds contacts of a cloth's samples with bodies and the ground: half-spaces before the surface
/// point that was closest at the start of the step. A sample outside cannot have changed sides, so
/// the direction from that point to it is the normal, also for open surfaces. Samples inside closed
/// bodies are pushed out gently; samples outside a body that keeps the cloth in are pushed back in.
class BodyContacts {
 public:
  struct Ground {
    double height = 0, friction = 0;
  };
  /// @param grid  kept by reference
  BodyContacts(const SurfaceGrid& grid, const CollidingCloth& cloth);

  /// How far samples inside a body are pushed out at most in the steps to come. [m]
  void bound_exits(double farthest) { farthest_exit_ = farthest; }
  /// @param ground  none: null
  void find(const MovingCloth& cloth, std::span<const ContactBody> bodies, const Ground* ground,
            ThreadTeam& team);
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }
  [[nodiscard]] const InsideMarks& inside() const { return marks_.inside; }
  /// Marks a sample as doubtful: a body moved onto it in the last step, so it may be inside now.
  void doubt(int sample) { marks_.doubted[sample] = 1; }
  /// Saves the inside mark and the doubt of every sample, for resuming a run. Empty before the
  /// marks are known.
  void save(std::vector<int>& marks) const;
  void restore(std::span<const int> marks);
  /// Keeps the present marks for rollback, which returns to them.
  void commit() { kept_marks_ = marks_; }
  /// Accepts a motion: the body stays at its end.
  /// @param body  from 0
  void arrive(std::size_t body, int motion);
  void rollback() { marks_ = kept_marks_; }

 private:
  void find_for_sample(const MovingCloth& cloth, std::span<const ContactBody> bodies,
                       const Ground* ground, int sample, std::vector<Contact>& out);
  void find_body(const MovingCloth& cloth, const ContactBody& body, bool deep, int sample,
                 std::vector<Contact>& out);
  [[nodiscard]] bool keeps_in(const ContactBody& body) const {
    return !kept_in_.empty() && kept_in_[body.number - 1] != 0;
  }
  void find_ground(const MovingCloth& cloth, const Ground& ground, int sample,
                   std::vector<Contact>& out) const;
  /// Motion of a body near a block of the cloth: summed over past steps, and in the present step.
  /// [m]
  struct NearBlock {
    Vec3d carried;
    double travelled = 0;
    BlockMotion::Near now;
  };
  /// Cached lower bound of the distance of a sample to a body, and the place where it was measured,
  /// less the displacement that the body had carried the place along by.
  struct Known {
    Vec3d place;
    Vec3f seen;            // position at the last query [m]
    double travelled = 0;  // NearBlock::travelled at that time [m]
    float distance = 0;    // at least; 0: unknown [m]
    int triangle = -1;     // the closest one
  };
  struct Past {
    std::vector<Known> samples;     // [n * n]
    std::vector<NearBlock> blocks;  // of the cloth
    int motion = 0;                 // of the body, to which `now` belongs
  };
  void find_near_blocks(const MovingCloth& cloth, const ContactBody& body, ThreadTeam& team);
  [[nodiscard]] Box3f box_of_block(const Planes3& at, int block) const;
  [[nodiscard]] int blocks_a_side() const;
  [[nodiscard]] const NearBlock& block_of(const Past& past, int sample) const;
  [[nodiscard]] BlockMotion::Near near_of(const ContactBody& body, const NearBlock& block,
                                          Vec3d displacement) const;
  /// Largest distance that is cached. [m]
  [[nodiscard]] double farthest_known() const;
  /// The closest point of a body within `reach`, if any; updates the cached distance.
  std::optional<BodyPoint> find_closest(const ContactBody& body, const NearBlock& near, Vec3d start,
                                        double reach, Known& known) const;

  const SurfaceGrid& grid_;
  KeptGap kept_;
  double farthest_exit_ = HUGE_VAL;
  std::vector<char> kept_in_;  // per body; empty: by none
  std::vector<Past> past_;     // of each body
  struct Marks {
    InsideMarks inside;         // [n * n]
    std::vector<char> doubted;  // [n * n]
    bool looked = false;
  };
  Marks marks_, kept_marks_;
  ChunkedLists<std::vector<Contact>> found_;
  std::vector<Contact> contacts_;
};

}  // namespace weft
