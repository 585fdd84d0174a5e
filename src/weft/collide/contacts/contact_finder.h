#pragma once

#include <memory>
#include <span>
#include <vector>

#include "weft/collide/collision_world.h"
#include "weft/collide/contacts/corner_contacts.h"
#include "weft/collide/contacts/pair_contacts.h"
#include "weft/collide/untangle/untangler.h"

namespace weft {

/// The stage that finds the contacts of a step's proposals: of samples with bodies and the ground,
/// of triangles with sharp points of bodies, and between parts of cloth.
class ContactFinder {
 public:
  /// @param world  kept by reference
  ContactFinder(CollisionWorld& world, const Obstacles& obstacles);

  // In this order, once the world has placed its bodies and fitted its broad phase.
  void find_with_bodies(std::span<const MovingCloth> moving, double time_step, ThreadTeam& team);
  /// @param untangler  knows where cloths cross
  void find_between_cloths(std::span<const MovingCloth> moving, double time_step,
                           const Untangler& untangler, ThreadTeam& team);
  /// The same for other proposals of the step: contacts stay where both sides end near the ends
  /// that were taken last.
  void find_where_moved(std::span<const MovingCloth> moving, double time_step,
                        const Untangler& untangler, ThreadTeam& team);
  /// Takes the proposals' ends.
  void take_ends(std::span<const MovingCloth> moving);
  /// Adds contacts of an earlier solve of the step.
  void add_struck(std::span<const StruckContact> struck, double time_step);

  /// See Collider::share_contacts.
  void share(bool shared) { shares_ = shared; }
  [[nodiscard]] std::span<const Contact> contacts(std::size_t cloth) const {
    return found_[cloth].contacts;
  }
  /// Contacts with bodies and the ground.
  [[nodiscard]] std::span<const Contact> hard_contacts(std::size_t cloth) const {
    return std::span(found_[cloth].contacts).first(found_[cloth].hard);
  }
  [[nodiscard]] std::span<const SharedContact> shared() const { return shared_; }
  [[nodiscard]] bool anything_near() const { return near_; }
  [[nodiscard]] int self_contacts() const { return self_contacts_; }

 private:
  /// Contacts of one cloth.
  struct Found {
    explicit Found(std::unique_ptr<CornerContacts> of_corners, int cells)
        : corners(std::move(of_corners)), ends(cells) {}
    std::unique_ptr<CornerContacts> corners;
    PatchMotion ends;           // from those that were taken
    std::vector<char> moved{};  // [patches] whether they are far from there
    bool any_moved = false;
    std::vector<Contact> contacts{};  // hard ones first
    std::size_t hard = 0;
  };
  void learn_corners(const Obstacles& obstacles);
  [[nodiscard]] ClothPair pair_of(std::size_t i, std::size_t j, std::span<const MovingCloth> moving,
                                  double time_step, const Untangler& untangler) const;
  PairContacts& contacts_of(std::size_t i, std::size_t j) {
    return pair_contacts_[i * found_.size() + j];
  }
  /// Calls visit(i, j) for the pairs of cloths that may touch.
  template <class Visit>
  void for_pairs_of_cloths(const Visit& visit) const;
  void mark_moved(std::size_t cloth, const MovingCloth& moving);
  /// Adds what was found between cloths to the contacts with bodies.
  void add_found(std::size_t i, std::size_t j);
  void add_crossings(std::size_t cloth, std::size_t body, const MovingCloth& moving,
                     double time_step);
  [[nodiscard]] int count() const;

  CollisionWorld& world_;
  std::vector<Found> found_;  // of each cloth
  std::vector<SharedContact> shared_;
  std::vector<PairContacts> pair_contacts_;  // [cloths x cloths]
  int self_contacts_ = 0;
  bool near_ = false, shares_ = false;
};

}  // namespace weft
