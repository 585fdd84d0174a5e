#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/collide/broad_phase/chunks.h"
#include "weft/collide/broad_phase/path_boxes.h"
#include "weft/collide/collider.h"
#include "weft/collide/contacts/body_contacts.h"
#include "weft/collide/contacts/contact_body.h"

namespace weft {

/// Finds contacts between the insides of a cloth's triangles and sharp points of bodies, on corners
/// and edges that are sharper than the cloth's samples are dense. Sharp points are chosen once,
/// from a body's shape; in a step each descends the cloth's mip pyramid to the triangles near it. A
/// triangle and a body have one contact at most, between locally closest points.
class CornerContacts {
 public:
  /// @param grid  kept by reference
  CornerContacts(const SurfaceGrid& grid, const CollidingCloth& cloth);
  /// Learns the sharp points of the next body. @param body  placed at `shape`
  void add_body(const SurfaceGrid& grid, const BodyQuery& body, const Planes3& shape);

  /// Whether any body has sharp points.
  [[nodiscard]] bool any_sharp() const { return any_sharp_; }

  /// State of the cloth in a step.
  struct Step {
    const MovingCloth& cloth;
    const InsideMarks& inside;             ///< triangles with samples inside a body are left alone
    const PathBoxLevels* boxes = nullptr;  ///< of the cloth; null: fitted here
    float aside = 0;                       ///< how far the cloth may be outside the boxes [m]
  };
  /// @param bodies  in the order in which they were added
  void find(const Step& step, std::span<const ContactBody> bodies, ThreadTeam& team);
  [[nodiscard]] std::span<const Contact> contacts() const { return contacts_; }

 private:
  /// A sharp point near a triangle.
  struct Touch {
    int triangle = 0;  // 2 * cell + half
    int point = 0;
    double squared_distance = 0;      // at the start of the step [m^2]
    std::array<int, 2> edge{-1, -1};  // its ends, where the closest point lies on one
    bool counts = true;
  };
  /// Parameters of one search.
  struct Search {
    Step step;
    const ContactBody& body;
    const CollideKernels& kernels;
  };
  /// Sharp points that lie side by side on a body.
  struct Tile {
    int first = 0, count = 0;
  };
  struct SharpBody {
    std::vector<int> points;  // by tiles
    std::vector<Tile> tiles;
  };
  /// Nodes of one level of the cloth's pyramid.
  struct Nodes {
    std::array<Node, 16> nodes{};
    int count = 0;
  };
  [[nodiscard]] bool keeps_in(std::size_t body) const {
    return !kept_in_.empty() && kept_in_[body] != 0;
  }
  void find_touches(const Search& search, const SharpBody& sharp, ThreadTeam& team);
  [[nodiscard]] Nodes near_tile(const Search& search, std::span<const int> points) const;
  /// How near a point has to be to the cloth. [m]
  [[nodiscard]] float reach_of(const Search& search) const;
  void find_touches_of(const Search& search, const Nodes& nodes, int point,
                       std::vector<Touch>& out) const;
  void try_triangle(const Search& search, Touch touch, std::vector<Touch>& out) const;
  void make_contact(const Search& search, const Touch& touch, std::vector<Contact>& out) const;

  const SurfaceGrid& grid_;
  KeptGap kept_;
  double spacing_;                // [m]
  std::vector<char> kept_in_;     // per body; empty: by none
  std::vector<SharpBody> sharp_;  // of each body
  bool any_sharp_ = false;
  PathBoxLevels boxes_;  // where the broad phase has none
  ChunkedLists<std::vector<Touch>> near_;
  std::vector<Touch> touches_;
  ChunkedLists<std::vector<Contact>> found_;
  std::vector<Contact> contacts_;
};

}  // namespace weft
