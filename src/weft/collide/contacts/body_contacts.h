#pragma once

#include <vector>

#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/contact_body.h"
#include "weft/collide/contacts/near_samples.h"
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
  /// Whether any sample is known to be on the wrong side of a body. @param body  its number
  [[nodiscard]] bool any_inside(int body) const;
  /// Marks a sample as doubtful: a body moved onto it in the last step, so it may be inside now.
  void doubt(int sample) {
    marks_.doubted[sample] = 1;
    marks_.any = true;
  }
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
  /// The smallest signed distance of a sample to a body that is nearer than `reach`, see
  /// NearSamples. [m]
  double smallest_gap(const Planes3& positions, const ContactBody& body, double reach,
                      ThreadTeam& team);

 private:
  [[nodiscard]] NearSamples& near(const ContactBody& body);
  [[nodiscard]] std::span<const char> find_deep(const ContactBody& body);
  void find_row(const MovingCloth& cloth, std::span<const ContactBody> bodies, const Ground* ground,
                int row, std::vector<Contact>& out);
  void doubt_touching(std::span<const ContactBody> bodies, int row, int col);
  void find_ground(const MovingCloth& cloth, const Ground& ground, int row, int col,
                   std::vector<Contact>& out) const;
  void mark_inside(std::span<const ContactBody> bodies);
  [[nodiscard]] bool keeps_in(std::size_t body) const {
    return !kept_in_.empty() && kept_in_[body] != 0;
  }

  const SurfaceGrid& grid_;
  KeptGap kept_;
  double farthest_exit_ = HUGE_VAL;
  std::vector<char> kept_in_;      // per body; empty: by none
  std::vector<NearSamples> near_;  // of each body
  struct Marks {
    InsideMarks inside;         // [n * n]
    std::vector<char> doubted;  // [n * n]
    bool looked = false;
    bool any = false;  // a sample is inside or doubted
  };
  Marks marks_, kept_marks_;
  std::vector<char> deep_;      // [n * n] scratch
  std::vector<char> touching_;  // [n] whether a sample of the row is to be doubted
  ChunkedLists<std::vector<Contact>> found_;
  std::vector<Contact> contacts_;
};

}  // namespace weft
