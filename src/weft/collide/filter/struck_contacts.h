#pragma once

#include <span>
#include <vector>

#include "weft/collide/collision_world.h"
#include "weft/collide/contacts/contact_finder.h"
#include "weft/collide/filter/separating_planes.h"

namespace weft {

/// Contacts for what the filter had to hold back in a step, with which the step is solved again: a
/// solve that knows them leaves the filter little to do. They hold the closest points of both sides
/// as far apart as the step found them, within the gap, so that they add no energy. They hold what
/// the search for contacts leaves to the filter: triangles that a cloth without shear stiffness
/// folds onto their neighbours, and the other sides of creases, in a body and in the cloth. Valid
/// for the step whose planes they are made from, with the same start and length; kept ones for the
/// next steps, too, in the first of which a body that moves is taken to go on as it did.
class StruckContacts {
 public:
  /// @param world  kept by reference
  explicit StruckContacts(const CollisionWorld& world) : world_(world) {}

  // Planes and proposals are those of a step of the length `time_step` [s].

  /// Adds contacts for planes that moved points.
  /// @return whether any of them was not known
  bool learn(std::span<const SeparatingPlane> planes, std::span<const MovingCloth> moving,
             double time_step);
  /// Keeps contacts for the planes that moved points in a step, where their sides hardly moved
  /// relative to each other; of those that the step began with, which spared the filter the work,
  /// also the ones whose sides still touch.
  void keep(std::span<const SeparatingPlane> planes, std::span<const MovingCloth> moving,
            double time_step);
  /// Goes on to the next step, with what was kept.
  void commit();
  void clear();
  [[nodiscard]] std::span<const StruckContact> found() const { return found_; }
  /// Drops contacts of cloth that is being sewn, whose layers have to give way: there they are of
  /// one step alone, and of its frame.
  void end_frame();
  /// Begins with contacts of an earlier run, but those that are none in this world.
  void restore(std::span<const StruckContact> kept);

 private:
  void add(std::span<const SeparatingPlane> planes, std::span<const MovingCloth> moving,
           double time_step, std::vector<StruckContact>& out) const;
  /// Adds the way of its sides beside each other in the step.
  /// @return whether they went far since its normal was found
  bool slides(StruckContact& one, std::span<const MovingCloth> moving, double time_step) const;
  /// Keeps the contacts of the step whose sides still touch at its end.
  void keep_touching(std::span<const MovingCloth> moving, double time_step);
  bool goes_on(StruckContact& one, std::span<const MovingCloth> moving, double time_step) const;
  /// Whether seams of its cloths are being sewn.
  [[nodiscard]] bool is_sewn(const StruckContact& one) const;
  [[nodiscard]] double thickness_of(const StruckContact& one) const;
  [[nodiscard]] bool is_valid(const StruckContact& one) const;
  [[nodiscard]] StruckContact contact_of(const SeparatingPlane& plane,
                                         std::span<const MovingCloth> moving,
                                         double time_step) const;
  /// The direction along which a contact with a body holds cloth off.
  /// @param normal  of the plane, from the body  @param at  the body's point [m]
  [[nodiscard]] Vec3d away_from_body(const StruckContact& one, Vec3d normal, Vec3d at) const;
  /// Gives a contact the normal, offset and friction of its pair.
  /// @param normal    of the plane, towards the contact's first side
  /// @param distance  of the closest points at the start of the step [m]
  void hold_apart(const SeparatingPlane& plane, Vec3d normal, double distance,
                  StruckContact& out) const;

  const CollisionWorld& world_;
  std::vector<StruckContact> found_, kept_;  // by samples and cloths, each once
};

}  // namespace weft
