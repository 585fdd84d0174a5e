#include <vector>

#include <gtest/gtest.h>

#include "tests/cloth/validation.h"
#include "weft/collide/contacts/contact_response.h"

namespace weft {
namespace {

using namespace testing;

constexpr double side = 0.2, gravity = 9.81;

/// A swatch that lies on a slope of the given tangent, which rises along x.
class Slope {
 public:
  Slope(double tangent, double friction, const IntegratorOptions& options)
      : cosine_(1 / std::sqrt(1 + tangent * tangent)),
        sine_(tangent * cosine_),
        cloth_(swatch()),
        integrator_(make_integrator(options, cloth_, input_, team_)),
        response_(cloth_.mates),
        state_(rest_state(cloth_)) {
    const Vec3f normal = vec_cast<float>(Vec3d{-sine_, cosine_, 0});
    for (int s = 0; s < cloth_.size * cloth_.size; ++s)
      contacts_.push_back(
          {{s}, {1}, normal, dot(normal, state_.position.at(s)), static_cast<float>(friction), {}});
  }

  void go(double seconds) {
    const int steps = static_cast<int>(std::lround(seconds / input_.time_step));
    for (int i = 0; i < steps; ++i) {
      integrator_->begin(input_, state_);
      const ClothState& next = integrator_->iterate(contacts_);
      ClothState& proposal = integrator_->proposal();
      ASSERT_EQ(&next, &proposal);
      if (!integrator_->solves_contacts())
        response_.respond(
            {state_.position, proposal.position, proposal.velocity, cloth_.inverse_mass},
            {contacts_, integrator_->contact_forces()}, input_.time_step, team_);
      integrator_->end(state_);
    }
  }
  [[nodiscard]] ClothState state() const { return state_; }
  /// Of the centre, down the slope [m/s].
  [[nodiscard]] double speed() const {
    return -dot((1 / total_mass(cloth_)) * momentum(cloth_, state_), Vec3d{cosine_, sine_, 0});
  }
  [[nodiscard]] double wanted_acceleration(double friction) const {
    return gravity * (sine_ - friction * cosine_);
  }

 private:
  [[nodiscard]] Cloth swatch() const {
    Planes3 rest = flat_sheet(17);
    for (int s = 0; s < 17 * 17; ++s) {
      const Vec3d p = side * vec_cast<double>(rest.at(s));
      rest.set(s, vec_cast<float>(Vec3d{cosine_ * p.x, 1 + sine_ * p.x, p.z}));
    }
    return make_cloth(rest, no_mates(17), soft_fabric);
  }

  double cosine_, sine_;
  ThreadTeam team_{1};
  StepInput input_{1.0 / 240, {0, static_cast<float>(-gravity), 0}};
  Cloth cloth_;
  std::unique_ptr<Integrator> integrator_;
  ContactResponse response_;
  ClothState state_;
  std::vector<Contact> contacts_;
};

/// The farthest that any particle went, once contacts have given way elastically as far as they do
/// [m].
double creep(double tangent, double friction, double seconds, const IntegratorOptions& options) {
  Slope slope(tangent, friction, options);
  slope.go(0.1);
  const ClothState before = slope.state();
  slope.go(seconds);
  const ClothState after = slope.state();
  float farthest = 0;
  for (int s = 0; s < 17 * 17; ++s)
    farthest = std::max(farthest, length(after.position.at(s) - before.position.at(s)));
  return farthest;
}

void check_friction(const IntegratorOptions& options, double seconds) {
  const double friction = 0.6;
  const std::string name(name_of(options));
  // The forces of implicit are known to a few percent.
  const bool exact = std::holds_alternative<MultigridOptions>(options);
  for (const double tangent : {0.1, 0.4, exact ? 0.59 : 0.5})
    check(
        fmt::format("friction 0.6 on a slope of {}, {}: creep in {} s [m]", tangent, name, seconds),
        0, creep(tangent, friction, seconds, options), 1e-5 * side);
  for (const double tangent : {0.7, 0.9}) {
    Slope slope(tangent, friction, options);
    slope.go(0.5);
    const double wanted = slope.wanted_acceleration(friction);
    check(fmt::format("friction 0.6 on a slope of {}, {}: acceleration [m/s^2]", tangent, name),
          wanted, slope.speed() / 0.5, 0.02 * wanted);
  }
}

const std::vector<IntegratorOptions> baselines{MultigridOptions{}, ImplicitOptions{}};

TEST(ValidationFriction, SwatchSticksOrSlidesByCoulombsLaw) {
  for (const IntegratorOptions& options : baselines) check_friction(options, 1);
}

TEST(ValidationFriction, SwatchSticksOrSlidesByDefault) { check_friction(NewtonOptions{}, 1); }

TEST(ValidationFriction, DISABLED_SwatchSticksForAMinute) {
  for (const IntegratorOptions& options : baselines) check_friction(options, 60);
  check_friction(NewtonOptions{}, 60);
}

}  // namespace
}  // namespace weft
