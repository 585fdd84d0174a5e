#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "weft/collide/collider.h"
#include "weft/core/contact_uses.h"

namespace weft {

/// Contacts of one cloth, and what is known of how hard they press.
struct PressedContacts {
  std::span<const Contact> contacts;
  std::span<const float> forces;  ///< normal, in the same order; empty: nothing is known [N]
};

/// What contacts of any number of samples do to a cloth at the end of a step, be they solved for or
/// not: what is beyond its half-space is pushed out by inverse masses and stops moving inwards;
/// then Coulomb's friction takes back the tangential motion that the contact's point made in the
/// step, less the obstacle's slide. That is all of it when its length is at most
///   mu (force h^2 / m + depth pushed),   1 / m = sum of w_i^2 / m_i,
/// so that what sticks is where it was, without creep; else so much of it. Velocities lose alike.
/// The start of the step is friction's anchor: nothing is carried over to the next step.
///
/// All contacts at once, a fixed number of times at most [tonge12: a particle's mass is divided
/// among its contacts, which keeps momentum and converges]. Mates stay bit-equal and pins where
/// they are. Results are the same for any team; nothing allocates once warmed up.
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
    int pushers = 0, holders = 0;  // contacts at work on it
  };
  /// A contact's point, and what has been done to it.
  struct Point {
    std::array<int, 4> particles{};
    std::array<double, 4> weights{};  // those that are 0 come last
    Vec3d normal, surface_displacement;
    double friction = 0, compliance = 0;  // sum of w^2 / m [1/kg]
    double target = 0;                    // least n . value
    double lift = 0;                      // left of the contact's
    Vec3d reference, value;               // what friction would restore, what is
    double depth = 0;                     // target - n . value
    double force_direction = 0;           // what the force moved it by [m]
    double hold = 0;                      // most that friction may take
    Vec3d held;                           // what it took
    Vec3d impulse;
    bool gains = true;                   // whether being pushed adds to hold
    bool sticks = false, stuck = false;  // now; when positions were done
    bool pushed = false, obstacle = false;

    [[nodiscard]] bool holds() const { return hold > 0 || (gains && friction > 0 && depth > 0); }
  };
  using Field = Vec3d Particle::*;

  void collect(const MovingCloth& cloth, const PressedContacts& pressed, double time_step);
  void take_contact(int index, const Contact& contact);
  void place_point(const Contact& contact, double force_squared_step, Point& point) const;
  /// What passes need.
  struct RelaxationPasses {
    Field field;
    int first_pass = 0;  // in busy_
    double hair = 0;     // moving no point by more counts as rest
  };
  void relax(const RelaxationPasses& relaxation, Worker& worker);
  void evaluate_depth(Field field, Point& point) const;
  void count(int particle);
  [[nodiscard]] double push_out(Point& point) const;
  void move(Field field, int particle);
  static void turn_to_velocities(double time_step, Point& point);
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
