#pragma once

#include <memory>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/collide/collision_world.h"
#include "weft/collide/contacts/contact_finder.h"
#include "weft/collide/contacts/contact_response.h"
#include "weft/collide/filter/step_filter.h"
#include "weft/collide/filter/struck_contacts.h"
#include "weft/collide/untangle/untangler.h"

namespace weft {

/// Collider in stages over one CollisionWorld: the broad phase finds candidate pairs; contacts are
/// found for the solve; the response pushes out what the solve left inside; the filter keeps
/// features on their sides of separating planes, so that nothing passes; cloth that starts crossed
/// is untangled. Works with any broad phase.
class ContactPipeline final : public Collider {
 public:
  ContactPipeline(CollisionWorld::MakeBroadPhase make_broad_phase, const Obstacles& obstacles,
                  std::span<const CollidingCloth> cloths);

  void move_bodies(std::span<const Planes3* const> ends, ThreadTeam& team) noexcept override {
    world_.move_bodies(ends, team);
  }
  [[nodiscard]] const BlockMotion* motion_of(std::size_t body) const noexcept override {
    return world_.motion_of(body);
  }
  void bury(std::size_t body, std::span<const char> buried) noexcept override {
    world_.bury(body, buried);
  }
  void detect(std::span<const MovingCloth> cloths, double time_step,
              ThreadTeam& team) noexcept override;
  void detect_again(std::span<const MovingCloth> cloths, double time_step,
                    ThreadTeam& team) noexcept override;
  [[nodiscard]] std::span<const Contact> contacts(std::size_t cloth) const noexcept override {
    return finder_.contacts(cloth);
  }
  [[nodiscard]] std::span<const Contact> obstacle_contacts(
      std::size_t cloth) const noexcept override {
    return finder_.hard_contacts(cloth);
  }
  void share_contacts(bool shared) noexcept override { finder_.share(shared); }
  [[nodiscard]] std::span<const SharedContact> shared_contacts() const noexcept override {
    return finder_.shared();
  }
  [[nodiscard]] bool anything_near() const noexcept override { return finder_.anything_near(); }
  int filter_guess(std::span<const MovingCloth> cloths, double time_step,
                   ThreadTeam& team) noexcept override;
  int correct(std::size_t cloth, const MovingCloth& moving, std::span<const float> forces,
              double time_step, ThreadTeam& team) noexcept override;
  FilterCounts filter(std::span<const MovingCloth> cloths, double time_step, ThreadTeam& team,
                      FilterEnd end) noexcept override;
  bool learn_struck(std::span<const MovingCloth> cloths, double time_step) noexcept override {
    return struck_.learn(filter_.struck(), cloths, time_step);
  }
  void commit() noexcept override;
  void rollback() noexcept override;
  void end_frame() noexcept override;
  void forget() noexcept override;
  void save_marks(std::size_t cloth, std::vector<int>& marks) const override;
  void restore_marks(std::size_t cloth, std::span<const int> marks) override;
  [[nodiscard]] std::span<const StruckContact> struck() const noexcept override {
    return struck_.found();
  }
  void restore_struck(std::span<const StruckContact> kept) override { struck_.restore(kept); }
  [[nodiscard]] int self_contacts() const noexcept override { return finder_.self_contacts(); }
  [[nodiscard]] int crossings() const noexcept override { return untangler_.crossings(); }
  double smallest_gap(std::size_t cloth, const Planes3& positions,
                      ThreadTeam& team) noexcept override;

 private:
  void find_tangles(std::span<const MovingCloth> cloths, ThreadTeam& team);

  CollisionWorld world_;
  Untangler untangler_;
  ContactFinder finder_;
  std::vector<ContactResponse> responses_;  // of each cloth
  StepFilter filter_;
  StruckContacts struck_;
};

/// Makes the pipeline with the broad phase `Pairs`.
template <class Pairs>
std::unique_ptr<Collider> make_pipeline(const Obstacles& obstacles,
                                        std::span<const CollidingCloth> cloths) {
  return std::make_unique<ContactPipeline>(
      [](std::span<const SurfaceGrid* const> grids, std::size_t count)
          -> std::unique_ptr<BroadPhase> { return std::make_unique<Pairs>(grids, count); },
      obstacles, cloths);
}

}  // namespace weft
