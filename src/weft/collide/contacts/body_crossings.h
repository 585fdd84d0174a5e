#pragma once

#include <span>
#include <vector>

#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/contacts/body_contacts.h"
#include "weft/collide/contacts/contact_body.h"
#include "weft/collide/moving_surface.h"
#include "weft/contact.h"

namespace weft {

/// The triangles of a cloth that cross a closed body at the start of a step, as where the cloth
/// begins in it. All their corners may be outside, as round an edge of the body. They have contacts
/// that bring them out, and no planes part them from the body: held off those of its triangles that
/// they do not cross yet, they could not slide out. Their neighbours are held by planes, so that no
/// other triangle comes to cross.
class BodyCrossings {
 public:
  /// Whether the next step has to look for any, as until it finds none.
  [[nodiscard]] bool is_open() const { return open_; }
  void recheck() { open_ = true; }
  /// Forgets what was found, for another state of a run.
  void forget();

  /// A cloth and a body at the start of a step.
  struct Standing {
    const SurfaceGrid& grid;
    const Planes3& cloth;  ///< [n x n] [m]
    const SurfaceGrid& body_grid;
    const ContactBody& body;
  };
  /// @param cells  all pairs of cells of the cloth and the body that may meet
  void find(const Standing& standing, std::span<const CandidateTile> cells, ThreadTeam& team);
  /// Whether a triangle of the cloth crosses the body.
  [[nodiscard]] bool crosses(int cell, int half) const {
    return !meetings_.empty() && crosses_[2 * static_cast<std::size_t>(cell) + half] != 0;
  }

  /// How contacts bring triangles out.
  struct Exit {
    KeptGap kept;
    double farthest = 0;        ///< in the step [m]
    bool kept_in = false;       ///< the cloth belongs inside the body
    const InsideMarks& inside;  ///< of the samples
  };
  /// Adds a contact for each such triangle of which no sample is inside, as those have their own;
  /// of the proposals of the step.
  void add_contacts(const SurfaceGrid& grid, const MovingCloth& cloth, const ContactBody& body,
                    const Exit& exit, std::vector<Contact>& out) const;

 private:
  /// The segments in which a triangle and some of the body's meet.
  struct Meeting {
    int triangle = 0;       // 2 * cell + half
    int body_triangle = 0;  // the first of them
    Vec3d sum;              // of their ends [m]
    int ends = 0;
  };
  static void try_pair(const Standing& standing, int triangle, int body_triangle,
                       std::vector<Meeting>& out);
  void clear();
  /// Makes one meeting of all that a triangle has.
  void join_meetings();

  bool open_ = true;
  ChunkedLists<std::vector<Meeting>> found_;
  std::vector<Meeting> meetings_;  // one a triangle, ascending
  std::vector<char> crosses_;      // [2 * (n - 1)^2] of the triangles
};

}  // namespace weft
