#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/core/contact_uses.h"

namespace weft {

/// Contacts of one cloth and their normal forces.
struct PressedContacts {
  std::span<const Contact> contacts;
  std::span<const float> forces;  ///< normal forces, in the same order; empty: unknown [N]
};

/// Contact response at the end of a step, whether the contacts were solved for or not. A point
/// beyond its half-space is pushed out by inverse masses and loses its inward velocity; then
/// Coulomb friction takes back the tangential displacement of the contact's point in the step
/// relative to the obstacle. That is all of it when its length is at most
///   mu (force h^2 / m + depth pushed),   1 / m = sum of w_i^2 / m_i,
/// so that sticking contacts do not creep; else this much of it. Velocities lose the same. The
/// start of the step is friction's anchor: nothing is carried over to the next step.
///
/// All contacts are relaxed at once, in a bounded number of passes [tonge12: a particle's mass is
/// divided among its contacts, which keeps momentum and converges]. Mates stay bit-equal and pins
/// where they are. Results are the same for any team; nothing allocates once warmed up.
class ContactResponse {
 public:
  /// @param mates  kept by reference
  explicit ContactResponse(const BorderMates& mates) : mates_(mates) {}

  /// @return how many particles press on an obstacle or were pushed out of one
  int respond(const MovingCloth& cloth, const PressedContacts& pressed, double time_step,
              ThreadTeam& team) noexcept;

 private:
  struct Particle {
    int sample = 0;  // representative
    double inverse_mass = 0;
    Vec3d start, position, velocity;
    int pushers = 0, holders = 0;  // contacts that push it, or hold it by friction
  };
  /// A contact's point and its response so far.
  struct Point {
    std::array<int, 4> particles{};
    std::array<double, 4> weights{};  // those that are 0 come last
    Vec3d normal, surface_displacement;
    double friction = 0, compliance = 0;  // sum of w^2 / m [1/kg]
    double target = 0;                    // least n . value
    double lift = 0;                      // rest of the contact's lift
    Vec3d reference, value;               // value that friction would restore, present value
    double depth = 0;                     // target - n . value
    double force_direction = 0;           // displacement by the force [m]
    double hold = 0;                      // limit of the displacement that friction takes back
    Vec3d held;                           // what friction has taken back
    Vec3d impulse;
    bool gains = true;                   // whether being pushed adds to hold
    bool sticks = false, stuck = false;  // now; after the position passes
    bool pushed = false, obstacle = false;

    [[nodiscard]] bool holds() const { return hold > 0 || (gains && friction > 0 && depth > 0); }
  };
  using Field = Vec3d Particle::*;

  void collect(const MovingCloth& cloth, const PressedContacts& pressed, double time_step);
  void add_contact(int index, const Contact& contact);
  void place_point(const Contact& contact, double force_squared_step, Point& point) const;
  /// Parameters of the relaxation passes.
  struct RelaxationPasses {
    Field field;
    int first_pass = 0;  // in busy_
    double hair = 0;     // smaller displacements of points count as rest
  };
  void relax(const RelaxationPasses& relaxation, Worker& worker);
  void evaluate_depth(Field field, Point& point) const;
  void count(int particle);
  [[nodiscard]] double push_out(Point& point) const;
  void move(Field field, int particle);
  static void convert_to_velocities(double time_step, Point& point);
  void write_back(const MovingCloth& cloth, int particle, double time_step) const;
  void copy_to_mates(Planes3& planes, Worker& worker) const;
  [[nodiscard]] int count_touching() const;

  const BorderMates& mates_;
  std::optional<ContactUses> uses_;  // by representative
  int samples_ = 0;                  // of uses_
  std::vector<Particle> particles_;
  std::vector<Point> points_;
  std::vector<char> busy_;  // [passes x team] whether a worker had something to do
};

}  // namespace weft
