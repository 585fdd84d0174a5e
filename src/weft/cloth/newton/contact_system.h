#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/integrator.h"
#include "weft/cloth/newton/contact_history.h"
#include "weft/cloth/newton/contact_product.h"
#include "weft/cloth/newton/padded_planes.h"

namespace weft {

/// Contacts and Coulomb friction of one or several cloths as part of a linearised step. An active
/// contact holds its point at its half-space by a stiff spring along the normal. If it sticks, it
/// has a tangential spring as well; if it slips, the point is dragged with the friction coefficient
/// times the normal force. All terms are linear in the step's unknown until choose() updates them,
/// as in the lagged friction of [li20]. A contact that persists from the last step starts with the
/// friction that it had.
///
/// A penetration at the start of the step is resolved at a bounded speed.
class ContactSystem {
 public:
  /// @param cloths  kept by pointer
  explicit ContactSystem(std::span<const Cloth* const> cloths);

  /// One cloth's own contacts, its positions at the start of the step and its contact history.
  struct Own {
    std::span<const Contact> contacts;
    const PaddedVectors* start = nullptr;     ///< valid until the last use [m]
    const ContactHistory* history = nullptr;  ///< also of shared contacts, see remember
  };
  /// Replaces all contacts.
  void set_contacts(std::span<const Own> own, std::span<const SharedContact> shared,
                    const StepInput& input);
  [[nodiscard]] bool empty() const { return contacts_.empty(); }

  /// A vector at each sample of every cloth.
  using Fields = std::span<const PaddedVectors* const>;

  // To be called by every worker of the team; each but the first ends with a barrier.

  /// Computes the compliance of a cloth's samples.
  /// @param diagonal  the springs' diagonal blocks, summed over seam copies [N/m]
  void hold(std::size_t cloth, const PlaneSet& diagonal, const Worker& worker);
  /// Computes the stiffness and depth of all contacts at the linearisation.
  /// @param position  of the cloths [m]
  void place(Fields position, Worker& worker);
  /// Decides which contacts are active and which of them stick after a step from the linearisation.
  /// The first decision is that of the guess, with the forces and friction of the last step. The
  /// product's loads become what the contact forces gain on those of the last choice since place()
  /// [N].
  /// @param step  null: none was made since the linearisation
  /// @return whether any contact changed
  bool choose(const Fields* step, Worker& worker);
  /// Whether after a step any contact between layers that is not active is passed, by more than
  /// this speed covers in a step [m/s]; all workers get it.
  bool any_layer_passed(Fields step, double speed, Worker& worker);
  /// The energy of all contacts after a part of a step: of penetrations, and of the linear
  /// friction; all workers get it [J].
  double energy(Fields step, float part, Worker& worker);
  /// The work of the contact forces on the cloths along a step from the linearisation, under the
  /// choices made on the way; all workers get it [J].
  double work_on_cloths(Fields step, Worker& worker);
  /// The work of moving obstacles with the contact forces after a step; all workers get it [J].
  double work(Fields step, Worker& worker);
  /// The sum of the forces of obstacles on all cloths after a step; all workers get it [N].
  Vec3d obstacle_force(Fields step, Worker& worker);
  /// Computes the contact forces after the last step.
  /// @param position  of the cloths then [m]
  void measure(Fields position, Worker& worker);
  /// Adds the measured contacts to the history of a cloth.
  void remember(std::size_t cloth, ContactHistory& history) const;

  /// Normal forces of a cloth's own contacts, in the order of set_contacts [N].
  [[nodiscard]] std::span<const float> forces(std::size_t cloth) const;
  /// Number of active contacts.
  [[nodiscard]] int active() const { return active_; }
  /// Whether a contact with an obstacle is active on a cloth; contacts within a cloth have no net
  /// force.
  [[nodiscard]] bool is_held(std::size_t cloth) const { return obstructed_[cloth] != 0; }
  /// Whether any contact between cloths is active.
  [[nodiscard]] bool is_shared() const { return shared_; }
  /// The contacts' part of the Hessian: of those that are active, and were before the last choice.
  [[nodiscard]] ContactProduct& product() { return product_; }
  [[nodiscard]] const ContactProduct& product() const { return product_; }

 private:
  /// Cloth, row and column of a sample.
  struct Place {
    int cloth = 0, row = 0, col = 0;
  };
  void add(const Contact& contact, const std::array<int, 4>& cloths);
  void clear();
  [[nodiscard]] Vec3d sum(int index, Fields fields) const;
  [[nodiscard]] double compliance(int index, std::span<const Grid<float>* const> softness) const;
  [[nodiscard]] double attainable_offset(int index, double start_height) const;
  [[nodiscard]] double lone_compliance(int index) const;
  void recall(int index);
  /// A contact's point at the start of the step, and its displacement since [m].
  struct Motion {
    Vec3d start, displacement;
  };
  [[nodiscard]] Motion motion_of(int index, Fields position) const;
  void locate(int index, Fields position);
  [[nodiscard]] int second_of(std::size_t index) const;
  /// How a contact's point moved along its obstacle.
  struct Sliding {
    double distance;  ///< slip that stretches the tangential spring [m]
    double force;     ///< along the normal [N]
    bool is_new;      ///< whether the contact was inactive during that motion
  };
  [[nodiscard]] double grip_for(int index, const Sliding& sliding) const;
  [[nodiscard]] double foreseen_distance(int index, double distance) const;
  [[nodiscard]] double limiting_force(int index, double depth, double pressed) const;
  void choose(int index, Vec3d moved, Vec3d held);
  void pack(Worker& worker);
  void pack_one(int index);
  void count_holds();
  [[nodiscard]] bool is_with_obstacle(std::size_t index) const;
  [[nodiscard]] double depth_after(int index, Vec3d step) const;
  [[nodiscard]] Vec3d slid_after(int index, Vec3d step) const;
  [[nodiscard]] Vec3d force_after(int index, Vec3d moved) const;
  [[nodiscard]] double work_since_choice(int index, Vec3d moved) const;
  double sum_of_energies(Worker& worker);
  [[nodiscard]] Range share(const Worker& worker) const {
    return worker.share(static_cast<int>(contacts_.size()));
  }

  std::vector<const Cloth*> cloths_;
  ContactProduct product_;
  std::vector<Grid<float>> inverse_diagonals_;    // the same [m/N]
  std::vector<const Grid<float>*> held_, loose_;  // pointers to those, and to inverse masses [1/kg]
  std::vector<const PaddedVectors*> starts_;      // of each cloth [m]
  std::vector<const ContactHistory*> histories_;  // the same
  std::vector<std::size_t> firsts_;  // first of each cloth's own contacts, and of the shared ones
  StepInput input_;
  // Of each contact:
  std::vector<Contact> contacts_;
  std::vector<std::array<Place, 4>> places_;
  std::vector<float> work_stiffness_;  // normal stiffness when active [N/m]
  std::vector<float> stiffness_, grip_;
  std::vector<Vec3f> gained_;             // force by the last choice [N]
  std::vector<double> depth_;             // at the linearisation [m]
  std::vector<double> lift_;              // the part of it that only lifts the point [m]
  std::vector<Vec3d> slid_;               // tangential, relative to the obstacle [m]
  std::vector<const PastContact*> past_;  // null: new contact
  std::vector<float> force_, limiting_;   // normal force now, and the one that limits friction [N]
  std::vector<Vec3f> friction_;           // [N]
  std::vector<float> acceleration_;       // see PastContact [m/s^2]
  std::vector<Vec3d> moved_;              // from the linearisation to the last choice [m]
  std::vector<double> worked_;            // by its force on the way there [J]
  std::vector<double> first_slip_;        // slip distance of the guess [m]
  std::vector<double> energy_;            // or work [J]
  std::vector<char> changed_, touched_;   // by the last choice; active before or after it
  int active_ = 0;
  std::vector<char> obstructed_;  // of each cloth
  bool first_ = true, any_changed_ = false, shared_ = false;
};

}  // namespace weft
