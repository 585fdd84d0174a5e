#include "weft/cloth/baselines/contact_terms.h"

#include <algorithm>

#include "weft/cloth/mates.h"
#include "weft/core/contact_point.h"

namespace weft {

double ContactLoads::own_stiffness(const Contact& contact, const Grid<float>& inverse_diagonal) {
  const int n = inverse_diagonal.cols();
  double compliance = 0;
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    if (contact.weights[i] == 0) continue;
    const double w = contact.weights[i];
    compliance += w * w * inverse_diagonal(contact.samples[i] / n, contact.samples[i] % n);
  }
  return compliance > 0 ? 1 / compliance : 0;
}

void ContactLoads::set_contacts(std::span<const Contact> contacts) {
  contacts_ = contacts;
  stiffness_.assign(contacts.size(), 0.0F);
  grip_.assign(contacts.size(), 0.0F);
  load_.assign(contacts.size(), Vec3f{});
  stiff_ = 0;
  gather_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t k = 0; k < contacts[i].samples.size(); ++k)
      if (contacts[i].weights[k] != 0)
        gather_.add(contacts[i].samples[k], static_cast<int>(i), contacts[i].weights[k]);
  gather_.finish();
}

void ContactLoads::count(Worker& worker) {
  worker.barrier();
  if (worker.rank() == 0)
    stiff_ = static_cast<int>(std::count_if(stiffness_.begin(), stiffness_.end(),
                                            [](float stiffness) { return stiffness > 0; }));
  gather_.mark_rows(stiffness_, worker);
  worker.barrier();
}

namespace {

constexpr double contact_stiffness = 0.125;

}  // namespace

ContactTerms::ContactTerms(const Cloth& cloth)
    : cloth_(cloth), loads_(cloth), inverse_diagonal_(cloth.size, cloth.size) {
  for (Grid<float>& plane : blocks_) plane = Grid<float>(cloth.size, cloth.size);
}

void ContactTerms::set_contacts(std::span<const Contact> contacts, const Planes3& start,
                                double time_step) {
  loads_.set_contacts(contacts);
  time_step_ = time_step;
  force_.assign(contacts.size(), 0.0F);
  changed_.resize(contacts.size());
  target_.resize(contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vec3d normal = vec_cast<double>(contacts[i].normal);
    const double offset = attainable_offset(contacts[i], start, max_exit_speed * time_step);
    target_[i] = (offset - dot(normal, point_of(contacts[i], start))) / time_step;
  }
}

double ContactTerms::speed(int contact, const Planes3& velocity) const {
  const Contact& moving = loads_.contacts()[contact];
  return dot(vec_cast<double>(moving.normal), point_of(moving, velocity));
}

bool ContactTerms::choose(const Planes3& velocity, const Blocks& diagonal, Worker& worker) {
  if (loads_.contacts().empty()) return false;
  const Range rows = worker.share(cloth_.size);
  for (int r = rows.first; r < rows.last; ++r)
    for (int c = 0; c < cloth_.size; ++c) {
      const float trace = diagonal[0](r, c) + diagonal[3](r, c) + diagonal[5](r, c);
      inverse_diagonal_(r, c) = cloth_.inverse_mass(r, c) > 0 ? 3 / trace : 0;
    }
  worker.barrier();
  const std::span<float> stiffness = loads_.stiffness();
  const Range mine = worker.share(static_cast<int>(stiffness.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const bool pressed = target_[i] > speed(i, velocity), held = stiffness[i] > 0;
    changed_[i] = pressed != held ? 1 : 0;
    if (pressed == held) continue;
    const double own = ContactLoads::own_stiffness(loads_.contacts()[i], inverse_diagonal_);
    stiffness[i] = pressed ? static_cast<float>(contact_stiffness * own) : 0.0F;
  }
  loads_.count(worker);
  if (worker.rank() == 0)
    any_changed_ = std::find(changed_.begin(), changed_.end(), 1) != changed_.end();
  renew_blocks(worker);
  return any_changed_;
}

void ContactTerms::renew_blocks(Worker& worker) {
  const Range rows = worker.share(cloth_.size);
  for (int r = rows.first; r < rows.last; ++r) {
    for (Grid<float>& plane : blocks_) std::fill(plane.row(r), plane.row(r) + cloth_.size, 0.0F);
    loads_.add_blocks(r, {blocks_[0].row(r), blocks_[1].row(r), blocks_[2].row(r),
                          blocks_[3].row(r), blocks_[4].row(r), blocks_[5].row(r)});
  }
  worker.barrier();
  sum_over_mates(cloth_.mates, worker,
                 {&blocks_[0], &blocks_[1], &blocks_[2], &blocks_[3], &blocks_[4], &blocks_[5]});
  worker.barrier();
}

void ContactTerms::aim(Worker& worker) {
  const Range mine = worker.share(static_cast<int>(target_.size()));
  for (int i = mine.first; i < mine.last; ++i)
    loads_.loads()[i] = static_cast<float>(double{loads_.stiffness()[i]} * target_[i]) *
                        loads_.contacts()[i].normal;
  worker.barrier();
}

void ContactTerms::multiply(const Planes3& velocity, Worker& worker) {
  const Range mine = worker.share(static_cast<int>(target_.size()));
  for (int i = mine.first; i < mine.last; ++i)
    if (const double k = loads_.stiffness()[i]; k > 0)
      loads_.loads()[i] = static_cast<float>(k * speed(i, velocity)) * loads_.contacts()[i].normal;
    else
      loads_.loads()[i] = {};
  worker.barrier();
}

void ContactTerms::measure(const Planes3& velocity, Worker& worker) {
  const Range mine = worker.share(static_cast<int>(target_.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const double k = loads_.stiffness()[i];
    const double impulse = k > 0 ? k * (target_[i] - speed(i, velocity)) : 0;
    force_[i] = static_cast<float>(std::max(0.0, impulse) / time_step_);
  }
  worker.barrier();
}

}  // namespace weft
