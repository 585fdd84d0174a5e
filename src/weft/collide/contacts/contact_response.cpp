#include "weft/collide/contacts/contact_response.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Largest number of passes over positions, and again over velocities.
constexpr int max_passes = 8;
/// Smaller displacements of points need no further pass [m].
constexpr double settled = 1e-8;
/// Rounding, as a part of a position's length: a sticking particle that moved by less returns to
/// its start.
constexpr double hair_of_size = 2.5e-7;

Vec3d along_surface(Vec3d displacement, Vec3d normal) {
  return displacement - dot(displacement, normal) * normal;
}

}  // namespace

int ContactResponse::respond(const MovingCloth& cloth, const PressedContacts& pressed,
                             double time_step, ThreadTeam& team) noexcept {
  if (pressed.contacts.empty()) return 0;
  collect(cloth, pressed, time_step);
  busy_.assign(static_cast<std::size_t>(2) * max_passes * team.size(), 0);
  team.run([&](Worker& worker) {
    relax({&Particle::position, 0, settled}, worker);
    const Range mine = worker.share(static_cast<int>(points_.size()));
    for (int i = mine.first; i < mine.last; ++i) convert_to_velocities(time_step, points_[i]);
    worker.barrier();
    relax({&Particle::velocity, max_passes, settled / time_step}, worker);
    const Range particles = worker.share(static_cast<int>(particles_.size()));
    for (int p = particles.first; p < particles.last; ++p) write_back(cloth, p, time_step);
    worker.barrier();
    for (Planes3* planes : {&cloth.position, &cloth.velocity}) copy_to_mates(*planes, worker);
  });
  return count_touching();
}

/// Collects the particles and points of contacts, before the response.
void ContactResponse::collect(const MovingCloth& cloth, const PressedContacts& pressed,
                              double time_step) {
  const int n = cloth.position.size(), count = static_cast<int>(pressed.contacts.size());
  if (!uses_ || samples_ != n * n) uses_.emplace(n * n);
  samples_ = n * n;
  uses_->clear();
  points_.resize(pressed.contacts.size());
  for (int i = 0; i < count; ++i) add_contact(i, pressed.contacts[i]);
  uses_->finish();
  particles_.resize(uses_->samples().size());
  for (std::size_t p = 0; p < particles_.size(); ++p) {
    const int s = uses_->samples()[p];
    particles_[p] = {.sample = s,
                     .inverse_mass = cloth.inverse_mass(s / n, s % n),
                     .start = vec_cast<double>(cloth.start.at(s)),
                     .position = vec_cast<double>(cloth.position.at(s)),
                     .velocity = vec_cast<double>(cloth.velocity.at(s))};
  }
  for (int i = 0; i < count; ++i) {
    const double force = pressed.forces.empty() ? 0 : double{pressed.forces[i]};
    place_point(pressed.contacts[i], force * time_step * time_step, points_[i]);
  }
}

/// Adds a contact's point, whose particles are representative samples as yet. Samples of one class
/// are one particle of added weights.
void ContactResponse::add_contact(int index, const Contact& contact) {
  Point& point = points_[index] = {};
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    if (contact.weights[i] == 0) continue;
    const int sample = mates_.representative(contact.samples[i]);
    std::size_t at = 0;
    while (point.weights[at] != 0 && point.particles[at] != sample) ++at;
    point.particles[at] = sample;
    point.weights[at] += contact.weights[i];
  }
  for (std::size_t i = 0; i < point.weights.size(); ++i)
    if (point.weights[i] != 0)
      uses_->add(point.particles[i], {index, static_cast<float>(point.weights[i])});
}

void ContactResponse::place_point(const Contact& contact, double force_squared_step,
                                  Point& point) const {
  Vec3d start;
  double sum = 0;
  for (std::size_t i = 0; i < point.weights.size(); ++i) {
    const double w = point.weights[i];
    if (w == 0) continue;
    point.particles[i] = uses_->index_of(point.particles[i]);
    const Particle& particle = particles_[point.particles[i]];
    point.compliance += w * w * particle.inverse_mass;
    start += w * particle.start;
    sum += w;
  }
  point.normal = vec_cast<double>(contact.normal);
  point.surface_displacement = vec_cast<double>(contact.surface_displacement);
  point.friction = contact.friction;
  point.target = double{contact.offset} + contact.lift;
  point.lift = contact.lift;
  point.reference = start + point.surface_displacement;
  point.force_direction = force_squared_step * point.compliance;
  point.hold = point.friction * point.force_direction;
  // Weights of a contact with an obstacle sum to 1, between parts of the cloth to 0.
  point.obstacle = sum > 0.5;
}

void ContactResponse::relax(const RelaxationPasses& relaxation, Worker& worker) {
  const Range points = worker.share(static_cast<int>(points_.size()));
  const Range particles = worker.share(static_cast<int>(particles_.size()));
  const std::size_t team = busy_.size() / (2 * max_passes);
  for (int pass = 0; pass < max_passes; ++pass) {
    char* busy = &busy_[(relaxation.first_pass + pass) * team];
    for (int i = points.first; i < points.last; ++i) evaluate_depth(relaxation.field, points_[i]);
    worker.barrier();
    for (int p = particles.first; p < particles.last; ++p) count(p);
    worker.barrier();
    for (int i = points.first; i < points.last; ++i)
      if (push_out(points_[i]) > relaxation.hair) busy[worker.rank()] = 1;
    worker.barrier();
    if (std::none_of(busy, busy + team, [](char any) { return any != 0; })) return;
    for (int p = particles.first; p < particles.last; ++p) move(relaxation.field, p);
    worker.barrier();
  }
}

void ContactResponse::evaluate_depth(Field field, Point& point) const {
  point.value = {};
  for (std::size_t i = 0; i < point.weights.size(); ++i)
    if (point.weights[i] != 0)
      point.value += point.weights[i] * (particles_[point.particles[i]].*field);
  point.depth = point.target - dot(point.normal, point.value);
}

void ContactResponse::count(int particle) {
  Particle& counted = particles_[particle];
  counted.pushers = counted.holders = 0;
  for (const ContactUses::Use& use : uses_->of(particle)) {
    const Point& point = points_[use.contact];
    if (point.depth > 0) ++counted.pushers;
    if (point.holds()) ++counted.holders;
  }
}

/// Computes the impulse of a point: h^2 times a force for positions, h times one for velocities.
/// @return length of the point's displacement by this impulse alone
double ContactResponse::push_out(Point& point) const {
  point.impulse = {};
  double push_compliance = 0, hold_compliance = 0;  // of particles whose mass is divided
  for (std::size_t i = 0; i < point.weights.size(); ++i) {
    if (point.weights[i] == 0) continue;
    const Particle& particle = particles_[point.particles[i]];
    const double own = point.weights[i] * point.weights[i] * particle.inverse_mass;
    push_compliance += particle.pushers * own;
    hold_compliance += particle.holders * own;
  }
  if (!(point.compliance > 0)) return 0;
  if (point.depth > 0) {
    point.impulse += (point.depth / push_compliance) * point.normal;
    if (point.gains) {
      const double pushed = point.depth * point.compliance / push_compliance;
      const double lifted = std::min(pushed, point.lift);
      point.lift -= lifted;
      point.hold += point.friction * (pushed - lifted);
    }
    point.pushed = true;
  }
  if (hold_compliance > 0 && point.hold > 0) {
    const double part = point.compliance / hold_compliance;
    const Vec3d slid = along_surface(point.value - point.reference, point.normal);
    Vec3d held = point.held - part * slid;
    const double wanted = length(held);
    point.sticks = wanted <= point.hold;
    if (!point.sticks) held = (point.hold / wanted) * held;
    point.impulse += (1 / point.compliance) * (held - point.held);
    point.held = held;
  }
  return point.compliance * length(point.impulse);
}

void ContactResponse::move(Field field, int particle) {
  Particle& moved = particles_[particle];
  for (const ContactUses::Use& use : uses_->of(particle))
    moved.*field += (moved.inverse_mass * double{use.weight}) * points_[use.contact].impulse;
}

/// Prepares a point for the velocity passes. Contacts that neither pressed nor were pushed leave
/// velocities alone.
void ContactResponse::convert_to_velocities(double time_step, Point& point) {
  const bool touches = point.pushed || point.force_direction > 0;
  point.reference = (1 / time_step) * point.surface_displacement;
  point.target = touches ? dot(point.normal, point.reference) : -HUGE_VAL;
  point.hold /= time_step;
  point.held = {};
  point.gains = false;
  point.stuck = point.sticks;
}

/// Writes a particle back; one that sticks and has moved by rounding alone gets exactly its start.
void ContactResponse::write_back(const MovingCloth& cloth, int particle, double time_step) const {
  const Particle& done = particles_[particle];
  if (!(done.inverse_mass > 0)) return;
  const std::span<const ContactUses::Use> uses = uses_->of(particle);
  const bool sticks = std::any_of(uses.begin(), uses.end(), [&](const ContactUses::Use& use) {
    return points_[use.contact].stuck && points_[use.contact].sticks;
  });
  const double hair = hair_of_size * length(done.start);
  const bool rests = sticks && length(done.position - done.start) <= hair;
  const bool still = sticks && length(done.velocity) * time_step <= hair;
  cloth.position.set(done.sample,
                     rests ? cloth.start.at(done.sample) : vec_cast<float>(done.position));
  cloth.velocity.set(done.sample, still ? Vec3f{} : vec_cast<float>(done.velocity));
}

void ContactResponse::copy_to_mates(Planes3& planes, Worker& worker) const {
  const Range classes = worker.share(mates_.class_count());
  for (int index = classes.first; index < classes.last; ++index) {
    const std::span<const int> samples = mates_.mates(index);
    for (const int sample : samples.subspan(1)) planes.set(sample, planes.at(samples.front()));
  }
}

int ContactResponse::count_touching() const {
  int touching = 0;
  for (int p = 0; p < static_cast<int>(particles_.size()); ++p)
    for (const ContactUses::Use& use : uses_->of(p)) {
      const Point& point = points_[use.contact];
      if (!point.obstacle || (!point.pushed && !(point.force_direction > 0))) continue;
      ++touching;
      break;
    }
  return touching;
}

}  // namespace weft
