#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "weft/cloth/baselines/conjugate_gradients.h"
#include "weft/cloth/baselines/spring_matrix.h"
#include "weft/cloth/bending.h"
#include "weft/cloth/integrator.h"
#include "weft/cloth/mates.h"
#include "weft/cloth/neighbours.h"
#include "weft/error.h"

namespace weft {
namespace {

/// Factor of the tolerance under contact: the forces of stiff contacts show errors that positions
/// hide.
constexpr double contact_tolerance = 0.1;
/// Largest number of solves to find the active contacts.
constexpr int max_turns = 3;

/// One linearised step of implicit Euler [baraff98],
///   (M - h df/dv - h^2 df/dx) dv = h (f + h df/dx v).
/// With S = -h df/dv - h^2 df/dx and v1 = v + dv it reads (M + S) v1 = M (v + h g) + h f, f the
/// elastic forces alone: the damping force -C v of the right side and the part of S on v cancel. In
/// this form a cloth in free fall needs no correction: v + h g is the solution, to the bit.
class Implicit final : public Integrator {
 public:
  Implicit(const ImplicitOptions& options, const Cloth& cloth, ThreadTeam& team)
      : options_(options),
        cloth_(cloth),
        team_(team),
        start_(rest_state(cloth)),
        next_(rest_state(cloth)),
        kernels_(implicit_kernels_for(team.instructions())),
        force_(cloth.size),
        right_(cloth.size),
        forces_(cloth, team.instructions()),
        springs_(cloth, team.instructions()),
        bending_(cloth, team.instructions()),
        contacts_(cloth),
        solver_(cloth, team.instructions()) {
    for (Grid<float>& plane : diagonal_) plane = Grid<float>(cloth.size, cloth.size);
  }

  void begin(const StepInput& input, const ClothState& state) noexcept override {
    const Stopwatch watch;
    input_ = input;
    report_ = {};
    contacts_.clear();
    team_.run([&](Worker& worker) {
      copy_rows(state, start_, worker);
      worker.barrier();
      bending_.curve(start_.position, worker);
      const Range mine = worker.share(cloth_.size);
      for (int r = mine.first; r < mine.last; ++r) {
        springs_.linearise_row(start_.position, input.time_step, r);
        forces_.gather_elastic(r, start_.position, force_);
        bending_.add_row(1, r, force_);
        fall_row(r);
      }
      worker.barrier();
      for (int r = mine.first; r < mine.last; ++r) diagonal_row(r);
      worker.barrier();
      sum_over_mates(cloth_.mates, worker,
                     {&diagonal_[0], &diagonal_[1], &diagonal_[2], &diagonal_[3], &diagonal_[4],
                      &diagonal_[5]});
    });
    set_pins(cloth_, start_, input_.time_step, next_);
    report_.forces_seconds = watch.seconds();
  }

  ClothState& proposal() noexcept override { return next_; }

  ClothState& iterate(std::span<const Contact> contacts) noexcept override {
    const Stopwatch watch;
    contacts_.set_contacts(contacts, start_.position, input_.time_step);
    set_pins(cloth_, start_, input_.time_step, next_);
    choose_contacts();
    solve();
    for (int turn = 1; turn < max_turns && choose_contacts(); ++turn) solve();
    team_.run([&](Worker& worker) {
      contacts_.measure(next_.velocity, worker);
      const Range mine = worker.share(cloth_.size);
      for (int r = mine.first; r < mine.last; ++r) move_row(r);
    });
    set_pins(cloth_, start_, input_.time_step, next_);
    report_.solve_seconds += watch.seconds();
    return next_;
  }

  [[nodiscard]] std::span<const float> contact_forces() const noexcept override {
    return contacts_.forces();
  }

  bool last_corrections(Grid<float>& sizes) const override {
    float largest = 0;
    for (int r = 0; r < cloth_.size; ++r)
      for (int c = 0; c < cloth_.size; ++c) {
        sizes(r, c) = length(solver_.direction().at(r, c));
        largest = std::max(largest, sizes(r, c));
      }
    const float scale = largest > 0 ? static_cast<float>(report_.residual) / largest : 0;
    for (int r = 0; r < cloth_.size; ++r)
      for (int c = 0; c < cloth_.size; ++c) sizes(r, c) *= scale;
    return true;
  }

  StepReport end(ClothState& state) noexcept override {
    accept(cloth_, next_, state, team_);
    return report_;
  }

  [[nodiscard]] std::string stability_advice(double /*time_step*/) const override { return {}; }

 private:
  [[nodiscard]] float squared_step() const {
    return static_cast<float>(input_.time_step * input_.time_step);
  }

  /// Updates the active contacts. @return whether they changed
  bool choose_contacts() {
    bool changed = false;
    team_.run([&](Worker& worker) {
      const bool mine = contacts_.choose(next_.velocity, diagonal_, worker);
      if (worker.rank() == 0) changed = mine;
    });
    return changed;
  }

  /// Solves for the velocities at the end of the step, with the active contacts.
  void solve() {
    team_.run([&](Worker& worker) {
      if (!contacts_.empty()) contacts_.aim(worker);
      const Range mine = worker.share(cloth_.size);
      for (int r = mine.first; r < mine.last; ++r) right_row(r);
    });
    const double to_residual = input_.time_step / cloth_.rest_spacing;
    const double tolerance = options_.tolerance * (contacts_.empty() ? 1 : contact_tolerance);
    const SolveReport solved = solver_.solve(
        {springs_, contacts_, diagonal_, bending_, squared_step()},
        {options_.max_iterations, tolerance / to_residual}, right_, next_.velocity, team_);
    report_.iterations += solved.iterations;
    report_.residual = solved.correction * to_residual;
  }

  /// State of a row at the start of the step, and the forces on it.
  [[nodiscard]] StartRow start_row(int row) const {
    const Vec3f g = input_.gravity;
    return {static_cast<float>(input_.time_step),
            {g.x, g.y, g.z},
            row_of(start_.position, row),
            row_of(start_.velocity, row),
            row_of(force_, row),
            cloth_.mass.row(row),
            cloth_.owner.row(row)};
  }

  /// The guess: v + h g and the positions that it leads to.
  void fall_row(int row) {
    kernels_.fall(cloth_.size, start_row(row), row_of(next_.velocity, row));
    move_row(row);
  }

  /// Diagonal blocks of M + S + bending, each sample's own part: the mass once a class.
  void diagonal_row(int row) {
    const float* mass = cloth_.mass.row(row);
    const float* owner = cloth_.owner.row(row);
    for (int i = 0; i < 6; ++i) {
      const bool on_diagonal = i == 0 || i == 3 || i == 5;
      float* out = diagonal_[i].row(row);
      for (int c = 0; c < cloth_.size; ++c) out[c] = on_diagonal ? mass[c] * owner[c] : 0.0F;
    }
    springs_.add_diagonal_row(diagonal_, row);
    if (!bending_.active()) return;
    const float* bending = cloth_.bending.diagonal.row(row);
    for (const int i : {0, 3, 5}) {
      float* out = diagonal_[i].row(row);
      for (int c = 0; c < cloth_.size; ++c) out[c] += squared_step() * bending[c];
    }
  }

  /// M (v + h g) + h f + contacts, each sample's own part.
  void right_row(int row) {
    const Row3 b = row_of(right_, row);
    kernels_.right_side(cloth_.size, start_row(row), b);
    if (contacts_.loads().row(row)) contacts_.loads().add_row(row, b);
  }

  void move_row(int row) {
    kernels_.move(cloth_.size, start_row(row), row_of(std::as_const(next_.velocity), row),
                  row_of(next_.position, row));
  }

  ImplicitOptions options_;
  const Cloth& cloth_;
  ThreadTeam& team_;
  StepInput input_;
  ClothState start_, next_;
  const ImplicitKernels& kernels_;
  Planes3 force_, right_;
  SpringForces forces_;
  SpringMatrix springs_;
  BendingPass bending_;
  Blocks diagonal_;
  ContactTerms contacts_;
  ConjugateGradients solver_;
  StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> make_integrator_of(const ImplicitOptions& options, const Cloth& cloth,
                                               const StepInput& /*typical*/, ThreadTeam& team) {
  if (options.max_iterations < 1)
    throw SceneError("integrator.max_iterations", fmt::format("{}", options.max_iterations),
                     "at least 1 is wanted");
  if (!std::isfinite(options.tolerance) || options.tolerance < 0)
    throw SceneError("integrator.tolerance", fmt::format("{}", options.tolerance),
                     "at least 0 is wanted");
  return std::make_unique<Implicit>(options, cloth, team);
}

}  // namespace weft
