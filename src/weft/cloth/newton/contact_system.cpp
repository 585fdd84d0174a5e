#include "weft/cloth/newton/contact_system.h"

#include <algorithm>
#include <cmath>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Times what the cloth's own springs hold the contact's point by.
constexpr double relative_stiffness = 0.125;
/// Limits of friction that differ by this part of them are alike.
constexpr double same_grip = 0.1;
/// What is inside something when a step begins, having been put or pressed there, leaves at this
/// speed at most, lest it be shot out. [m/s]
constexpr double fastest_way_out = 0.5;
/// What stands nearer than it should rises at this speed at most, which nobody sees. [m/s]
constexpr double lifting_speed = 0.02;

}  // namespace

ContactSystem::ContactSystem(const Cloth& cloth)
    : cloth_(cloth), loads_(cloth), inverse_diagonal_(cloth.size, cloth.size) {}

void ContactSystem::take(std::span<const Contact> contacts, const Planes3& start,
                         const StepInput& input) {
  loads_.take(contacts);
  start_ = &start;
  input_ = input;
  first_ = true;
  depth_.resize(contacts.size());
  lift_.resize(contacts.size());
  slid_.resize(contacts.size());
  changed_.assign(contacts.size(), 0);
  stiffness_.assign(contacts.size(), 0.0F);
  force_.assign(contacts.size(), 0.0F);
  energy_.resize(contacts.size());
}

Vec3d ContactSystem::sum(const Contact& contact, const PaddedVectors& field) const {
  Vec3d total;
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    if (w == 0) continue;
    const int r = contact.samples[i] / cloth_.size, c = contact.samples[i] % cloth_.size;
    total += w * Vec3d{field.x(r, c), field.y(r, c), field.z(r, c)};
  }
  return total;
}

void ContactSystem::place(const PaddedVectors& velocity, const PaddedBlocks& diagonal,
                          Worker& worker) {
  const Range rows = worker.share(cloth_.size);
  for (int r = rows.first; r < rows.last; ++r)
    for (int c = 0; c < cloth_.size; ++c) {
      const float trace =
          diagonal.entry[0](r, c) + diagonal.entry[3](r, c) + diagonal.entry[5](r, c);
      inverse_diagonal_(r, c) = cloth_.inverse_mass(r, c) > 0 ? 3 / trace : 0;
    }
  worker.barrier();
  const std::span<const Contact> contacts = loads_.contacts();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const Contact& contact = contacts[i];
    const Vec3d normal = vec_cast<double>(contact.normal);
    const bool soft = contact.stiffness > 0;
    const double own = ContactLoads::own_stiffness(contact, inverse_diagonal_);
    stiffness_[i] = soft ? contact.stiffness : static_cast<float>(relative_stiffness * own);
    const double h = input_.time_step;
    lift_[i] = soft ? 0 : std::min(double{contact.lift}, lifting_speed * h);
    const double offset = soft
                              ? double{contact.offset}
                              : attainable_offset(contact, *start_, fastest_way_out * h) + lift_[i];
    const Vec3d way = h * sum(contact, velocity);
    depth_[i] = offset - dot(normal, point_of(contact, *start_)) - dot(normal, way);
    const Vec3d relative = way - vec_cast<double>(contact.slide);
    slid_[i] = relative - dot(normal, relative) * normal;
  }
  worker.barrier();
}

double ContactSystem::depth_after(int index, Vec3d step) const {
  return depth_[index] - dot(vec_cast<double>(loads_.contacts()[index].normal), step);
}

Vec3d ContactSystem::slid_after(int index, Vec3d step) const {
  const Vec3d normal = vec_cast<double>(loads_.contacts()[index].normal);
  return slid_[index] + step - dot(normal, step) * normal;
}

double ContactSystem::lone_compliance(const Contact& contact) const {
  double compliance = 0;
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    const int s = contact.samples[i], n = cloth_.size;
    compliance += w * w * double{cloth_.inverse_mass(s / n, s % n)};
  }
  return compliance * input_.time_step * input_.time_step;
}

/// What friction can stop sticks. Else it drags with its whole force where that lets the point come
/// to: the point's way without friction, less what the force takes off it.
double ContactSystem::grip_for(int index, const Sliding& sliding) const {
  const Contact& contact = loads_.contacts()[index];
  const double compliance = lone_compliance(contact);
  if (!(compliance > 0)) return 0;
  // Before any solve a contact is taken to stop its own point alone.
  const double force = sliding.pressed ? double{stiffness_[index]} * sliding.depth
                       : first_        ? std::max(0.0, sliding.depth - lift_[index]) / compliance
                                       : 0;
  const double most = contact.friction * force * compliance;
  const double free = sliding.way * (1 + sliding.grip * compliance);
  if (free <= most) return stiffness_[index];
  return most / (compliance * (free - most));
}

bool ContactSystem::choose(int index, const PaddedVectors& step) {
  const Contact& contact = loads_.contacts()[index];
  float &k = loads_.stiffness()[index], &grip = loads_.grip()[index];
  const float k_before = k, grip_before = grip;
  Vec3d moved = sum(contact, step);
  if (first_) {
    double weight = 0;
    for (const float w : contact.weights) weight += w;
    const Vec3d fall = input_.time_step * input_.time_step * vec_cast<double>(input_.gravity);
    moved += weight * fall;
  }
  const double depth = depth_after(index, moved);
  k = depth > 0 ? stiffness_[index] : 0.0F;
  grip = k > 0 && contact.friction > 0
             ? static_cast<float>(grip_for(
                   index, {depth, length(slid_after(index, moved)), k_before > 0, grip_before}))
             : 0.0F;
  return (k > 0) != (k_before > 0) ||
         std::abs(grip - grip_before) > same_grip * std::max(grip, grip_before);
}

bool ContactSystem::choose(const PaddedVectors& step, Worker& worker) {
  const Range mine = worker.share(static_cast<int>(loads_.contacts().size()));
  for (int i = mine.first; i < mine.last; ++i) changed_[i] = choose(i, step) ? 1 : 0;
  loads_.count(worker);
  if (worker.rank() == 0) {
    any_changed_ = std::find(changed_.begin(), changed_.end(), 1) != changed_.end();
    first_ = false;
  }
  worker.barrier();
  return any_changed_;
}

void ContactSystem::load_forces(const PaddedVectors& step, Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const float k = loads_.stiffness()[i], grip = loads_.grip()[i];
    Vec3d load;
    if (k > 0) {
      const Vec3d moved = sum(contacts[i], step);
      load = double{k} * depth_after(i, moved) * vec_cast<double>(contacts[i].normal) -
             double{grip} * slid_after(i, moved);
    }
    loads_.loads()[i] = vec_cast<float>(load);
  }
  worker.barrier();
}

void ContactSystem::load_product(const PaddedVectors& direction, Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const double k = loads_.stiffness()[i], grip = loads_.grip()[i];
    Vec3d load;
    if (k > 0) {
      const Vec3d normal = vec_cast<double>(contacts[i].normal),
                  moved = sum(contacts[i], direction);
      load = (k - grip) * dot(normal, moved) * normal + grip * moved;
    }
    loads_.loads()[i] = vec_cast<float>(load);
  }
  worker.barrier();
}

double ContactSystem::energy(const PaddedVectors& step, float part, Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const Vec3d moved = double{part} * sum(contacts[i], step);
    const double depth = std::max(0.0, depth_after(i, moved)), grip = loads_.grip()[i];
    energy_[i] =
        0.5 * (double{stiffness_[i]} * depth * depth + grip * squared_length(slid_after(i, moved)));
  }
  worker.barrier();
  double total = 0;
  for (const double one : energy_) total += one;
  worker.barrier();
  return total;
}

void ContactSystem::measure(const PaddedVectors& step, Worker& worker) {
  const std::span<const Contact> contacts = loads_.contacts();
  const Range mine = worker.share(static_cast<int>(contacts.size()));
  for (int i = mine.first; i < mine.last; ++i)
    force_[i] = static_cast<float>(
        std::max(0.0, double{loads_.stiffness()[i]} * depth_after(i, sum(contacts[i], step))));
  worker.barrier();
}

}  // namespace weft
