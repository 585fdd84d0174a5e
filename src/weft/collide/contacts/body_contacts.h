#pragma once

#include <vector>

#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/contact_body.h"
#include "weft/contact.h"

namespace weft {

/// Which of a cloth's samples are on the wrong side of a closed body: its number, or 0.
using InsideMarks = std::vector<int>;

/// Contacts of a cloth's samples with bodies and the ground: the half-space before the point of a
/// surface that was closest at the start of the step. Outside, a sample cannot have changed sides,
/// so the way from there to it tells the side, also of open surfaces. Samples inside closed bodies
/// are pushed out, gently, and back in those outside of one that keeps the cloth in.
class BodyContacts {
 public:
  struct Ground {
    double height = 0, friction = 0;
  };
  /// @param grid  kept by reference
  BodyContacts(const SurfaceGrid& grid, const CollidingCloth& cloth);

  /// @param ground  none: null
  void find(const MovingCloth& cloth, std::span<const ContactBody> bodies, const Ground* ground,
            ThreadTeam& team);
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }
  [[nodiscard]] const InsideMarks& inside() const { return marks_.inside; }
  /// A body moved onto this sample in the last step, so it may be inside now.
  void doubt(int sample) { marks_.doubted[sample] = 1; }
  /// What is known of every sample, for going on elsewhere: its mark and whether it is in doubt.
  /// Empty before the first look.
  void save(std::vector<int>& marks) const;
  void restore(std::span<const int> marks);
  /// What is known of samples is kept for rollback, which returns to it.
  void commit() { kept_marks_ = marks_; }
  /// A body stays where a motion led it. @param body  from 0
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
  /// How a body moves near a block of the cloth: so far, and in the present step. [m]
  struct NearBlock {
    Vec3d carried;
    double travelled = 0;
    BlockMotion::Near now;
  };
  /// What is known of a sample and a body: how far it was, and from where, less what the body's
  /// motion had carried what is near along.
  struct Known {
    Vec3d place;
    Vec3f seen;            // where it was when it was last asked for [m]
    double travelled = 0;  // by the body when it was [m]
    float distance = 0;    // at least; 0: nothing is known [m]
    int triangle = -1;     // that was closest
  };
  struct Past {
    std::vector<Known> samples;     // [n * n]
    std::vector<NearBlock> blocks;  // of the cloth
    int motion = 0;                 // of the body, that `now` is of
  };
  void find_near_blocks(const MovingCloth& cloth, const ContactBody& body, ThreadTeam& team);
  [[nodiscard]] Box3f box_of_block(const Planes3& at, int block) const;
  [[nodiscard]] int blocks_a_side() const;
  [[nodiscard]] const NearBlock& block_of(const Past& past, int sample) const;
  [[nodiscard]] BlockMotion::Near near_of(const ContactBody& body, const NearBlock& block,
                                          Vec3d displacement) const;
  /// How far records reach [m].
  [[nodiscard]] double farthest_known() const;
  /// The closest point, if it matters; remembers what there was to be known.
  std::optional<BodyPoint> find_closest(const ContactBody& body, const NearBlock& near, Vec3d start,
                                        double reach, Known& known) const;

  const SurfaceGrid& grid_;
  KeptGap kept_;
  std::vector<char> kept_in_;  // by each body; empty: by none
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
