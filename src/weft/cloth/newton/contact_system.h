#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/integrator.h"
#include "weft/cloth/newton/contact_gather.h"
#include "weft/cloth/newton/contact_history.h"
#include "weft/cloth/newton/padded_planes.h"

namespace weft {

/// Contacts and Coulomb friction of one or several cloths as part of a linearised step: a contact
/// that presses holds its point at its half-space by a stiff spring along the normal; one that
/// sticks holds it there too, one that slips drags on it with its coefficient times the normal
/// force. All are linear in the step's unknown until choose() looks again, as in the lagged
/// friction of [li20]. A contact that held in the last step begins with the friction that it had.
///
/// What was beyond the half-space when the step began is not pushed out of it at any speed.
class ContactSystem {
 public:
  /// @param cloths  kept by pointer
  explicit ContactSystem(std::span<const Cloth* const> cloths);

  /// Of each cloth in their order: those that are its own, and where it was at the step's start.
  struct Own {
    std::span<const Contact> contacts;
    const Planes3* start = nullptr;           ///< valid until the last use [m]
    const ContactHistory* history = nullptr;  ///< the same; of shared ones whose first it is, too
  };
  /// Takes the place of the contacts before.
  void set_contacts(std::span<const Own> own, std::span<const SharedContact> shared,
                    const StepInput& input);
  [[nodiscard]] bool empty() const { return contacts_.empty(); }

  /// A vector at each sample of every cloth.
  using Fields = std::span<const PaddedVectors* const>;

  // To be called by every worker of the team; each but the first ends with a barrier.

  /// What holds the samples of a cloth.
  /// @param diagonal  the springs' diagonal blocks, summed over seam copies [N/m]
  void hold(std::size_t cloth, const PaddedBlocks& diagonal, const Worker& worker);
  /// Where points are at the linearisation. @param position  of the cloths [m]
  void place(Fields position, Worker& worker);
  /// Decides which contacts press, and which stick, where a step from the linearisation leads; the
  /// first time those that the guess meets press, with the forces and friction that they had.
  /// @return whether any is taken otherwise than before
  bool choose(Fields step, Worker& worker);
  /// The loads become the forces after a step [N].
  void load_forces(Fields step, Worker& worker);
  /// The loads become the contacts' part of the Hessian times a direction [N].
  void load_product(Fields direction, Worker& worker);
  /// The energy of all contacts, whose points are beyond their half-spaces after a part of a step,
  /// and of friction as it is taken; all workers get it [J].
  double energy(Fields step, float part, Worker& worker);
  /// What obstacles do by their motion, pressing and dragging as they do after a step; all workers
  /// get it [J].
  double work(Fields step, Worker& worker);
  /// Computes the forces where the last step led. @param position  of the cloths then [m]
  void measure(Fields position, Worker& worker);
  /// Adds what was measured to the history of a cloth.
  void remember(std::size_t cloth, ContactHistory& history) const;

  /// Of a cloth's own contacts, in the order in which they were taken [N].
  [[nodiscard]] std::span<const float> forces(std::size_t cloth) const;
  /// How many press.
  [[nodiscard]] int active() const { return active_; }
  /// Whether an obstacle presses on a cloth: what parts of cloths do to each other sums to nothing.
  [[nodiscard]] bool is_held(std::size_t cloth) const { return obstructed_[cloth] != 0; }
  /// Whether cloths press on each other.
  [[nodiscard]] bool is_shared() const { return shared_; }
  /// What gathers them to the samples of a cloth.
  [[nodiscard]] const ContactGather& gather(std::size_t cloth) const { return gathers_[cloth]; }
  [[nodiscard]] std::span<const Vec3f> loads() const { return load_; }
  [[nodiscard]] ContactGather::Springs springs() const { return {contacts_, stiffness_, grip_}; }

 private:
  /// Where a sample is.
  struct Place {
    int cloth = 0, row = 0, col = 0;
  };
  void add(const Contact& contact, const std::array<int, 4>& cloths);
  void clear();
  [[nodiscard]] Vec3d sum(int index, Fields fields) const;
  [[nodiscard]] Vec3d start_of(int index) const;
  [[nodiscard]] double compliance(int index, std::span<const Grid<float>* const> softness) const;
  [[nodiscard]] double attainable_offset(int index) const;
  [[nodiscard]] double lone_compliance(int index) const;
  void recall(int index);
  [[nodiscard]] Vec3d displacement_of(int index, Fields position) const;
  void locate(int index, Fields position);
  [[nodiscard]] int second_of(std::size_t index) const;
  /// How a contact's point moved along its obstacle.
  struct Sliding {
    double distance;  ///< that stretches what holds it [m]
    double force;     ///< along the normal [N]
    bool is_new;      ///< whether nothing held it as it moved so
  };
  [[nodiscard]] double grip_for(int index, const Sliding& sliding) const;
  [[nodiscard]] double foreseen_distance(int index, double distance) const;
  [[nodiscard]] double limiting_force(int index, double depth, double pressed) const;
  bool choose(int index, Fields step);
  void count(Worker& worker);
  void count_holds();
  [[nodiscard]] double depth_after(int index, Vec3d step) const;
  [[nodiscard]] Vec3d slid_after(int index, Vec3d step) const;
  [[nodiscard]] Vec3d force_after(int index, Fields step) const;
  double sum_of_energies(Worker& worker);
  [[nodiscard]] Range share(const Worker& worker) const {
    return worker.share(static_cast<int>(contacts_.size()));
  }

  std::vector<const Cloth*> cloths_;
  std::vector<ContactGather> gathers_;            // of each cloth
  std::vector<Grid<float>> inverse_diagonals_;    // the same [m/N]
  std::vector<const Grid<float>*> held_, loose_;  // those, and inverse masses [1/kg]
  std::vector<const Planes3*> starts_;            // of each cloth [m]
  std::vector<const ContactHistory*> histories_;  // the same
  std::vector<std::size_t> firsts_;               // of each cloth's own, and of shared ones
  StepInput input_;
  // Of each contact:
  std::vector<Contact> contacts_;
  std::vector<std::array<Place, 4>> places_;
  std::vector<float> work_stiffness_;  // when it presses [N/m]
  std::vector<float> stiffness_, grip_;
  std::vector<Vec3f> load_;
  std::vector<double> depth_;  // at the linearisation [m]
  std::vector<double> lift_;   // of that, what only raises the point [m]
  std::vector<Vec3d> slid_;    // along the obstacle, relative to it, with what friction left [m]
  std::vector<const PastContact*> past_;  // null where it is new
  std::vector<float> force_, limiting_;   // along the normal now, and as friction knows it [N]
  std::vector<Vec3f> friction_;           // [N]
  std::vector<float> acceleration_;       // see PastContact [m/s^2]
  std::vector<double> first_slip_;        // of the point before the solve [m]
  std::vector<double> energy_;            // or work [J]
  std::vector<char> changed_;
  int active_ = 0;
  std::vector<char> obstructed_;  // of each cloth
  bool first_ = true, any_changed_ = false, shared_ = false;
};

}  // namespace weft
