#include "weft/cloth/integrate/contact_springs.h"

#include <algorithm>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Times what the cloth's own operator holds the contact's point by.
constexpr double relative_stiffness = 4;
/// Nearer to the half-space than this part of the rest spacing counts as touching it.
constexpr double touching = 1e-3;

/// What holds a contact's point against a push along its normal: springs of 1 / inverse diagonal at
/// its samples, one behind the other. [N/m]
double own_stiffness(const Contact& contact, const Grid<float>& inverse_diagonal) {
  const int n = inverse_diagonal.cols();
  double compliance = 0;
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    if (contact.weights[i] == 0) continue;
    const double w = contact.weights[i];
    compliance += w * w * inverse_diagonal(contact.samples[i] / n, contact.samples[i] % n);
  }
  return compliance > 0 ? 1 / compliance : 0;
}

float sum_of_weights(const Contact& contact) {
  float sum = 0;
  for (const float w : contact.weights) sum += std::abs(w);
  return sum;
}

}  // namespace

ContactSprings::ContactSprings(const Cloth& cloth)
    : cloth_(cloth),
      class_at_(static_cast<std::size_t>(4) * (cloth.size - 1), -1),
      uses_(cloth.size * cloth.size),
      row_starts_(static_cast<std::size_t>(cloth.size) + 1),
      rows_(static_cast<std::size_t>(cloth.size)) {
  for (int index = 0; index < cloth.mates.class_count(); ++index)
    for (const int sample : cloth.mates.mates(index))
      class_at_[border_position(cloth.size, sample)] = index;
}

void ContactSprings::clear() { take({}); }

void ContactSprings::use(int sample, ContactUses::Use use) {
  const int position = border_position(cloth_.size, sample);
  const int index = position < 0 ? -1 : class_at_[position];
  if (index < 0) return uses_.add(sample, use);
  const std::span<const int> samples = cloth_.mates.mates(index);
  use.weight /= static_cast<float>(samples.size());
  for (const int s : samples) uses_.add(s, use);
}

void ContactSprings::take(std::span<const Contact> contacts, double farthest) {
  farthest_ = farthest;
  contacts_ = contacts;
  stiffness_.assign(contacts.size(), 0.0F);
  force_.assign(contacts.size(), 0.0F);
  offset_.resize(contacts.size());
  std::fill(rows_.begin(), rows_.end(), char{0});
  heeded_ = 0;
  uses_.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t k = 0; k < contacts[i].samples.size(); ++k)
      if (contacts[i].weights[k] != 0)
        use(contacts[i].samples[k], {static_cast<int>(i), contacts[i].weights[k]});
  uses_.finish();
  const std::span<const int> used = uses_.samples();
  int at = 0;
  for (int r = 0; r <= cloth_.size; ++r) {
    while (at < static_cast<int>(used.size()) && used[at] < r * cloth_.size) ++at;
    row_starts_[r] = at;
  }
}

bool ContactSprings::may_press(const Contact& contact, const Planes3& start,
                               const Planes3& now) const {
  const Vec3d n = vec_cast<double>(contact.normal);
  std::array<double, 2> before{}, after{};  // the heights of both sides
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    if (w == 0) continue;
    const std::size_t side = w > 0 ? 0 : 1;
    before[side] += w * dot(n, vec_cast<double>(start.at(contact.samples[i])));
    after[side] += w * dot(n, vec_cast<double>(now.at(contact.samples[i])));
  }
  const double least = std::min(before[0], after[0]) + std::min(before[1], after[1]);
  return contact.offset - least > -touching * cloth_.rest_spacing;
}

bool ContactSprings::heed(const Planes3& start, const Planes3& now,
                          const Grid<float>& inverse_diagonal, Worker& worker) {
  if (contacts_.empty()) return false;
  const Range mine = worker.share(static_cast<int>(contacts_.size()));
  for (int i = mine.first; i < mine.last; ++i) {
    const Contact& contact = contacts_[i];
    if (stiffness_[i] > 0 || !may_press(contact, start, now)) continue;
    stiffness_[i] =
        static_cast<float>(relative_stiffness * own_stiffness(contact, inverse_diagonal));
    const double before = depth_of(contact, start) - double{dot(contact.normal, contact.slide)};
    offset_[i] = contact.offset - std::max(0.0, before - farthest_);
  }
  worker.barrier();
  if (worker.rank() == 0) {
    const auto heeded = std::count_if(stiffness_.begin(), stiffness_.end(),
                                      [](float stiffness) { return stiffness > 0; });
    grown_ = heeded > heeded_;
    heeded_ = static_cast<int>(heeded);
  }
  mark_rows(worker);
  worker.barrier();
  return grown_;
}

void ContactSprings::mark_rows(Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r)
    for (int at = row_starts_[r]; at < row_starts_[r + 1] && rows_[r] == 0; ++at)
      for (const ContactUses::Use& use : uses_.of(at))
        if (stiffness_[use.contact] > 0) rows_[r] = 1;
}

double ContactSprings::depth_at(int index, const Place& place) const {
  const Contact& contact = contacts_[index];
  const Vec3d n = vec_cast<double>(contact.normal);
  double depth = offset_[index];
  for (std::size_t i = 0; i < contact.samples.size(); ++i) {
    const double w = contact.weights[i];
    if (w == 0) continue;
    const int s = contact.samples[i];
    depth -= w * dot(n, vec_cast<double>(place.from.at(s)) + vec_cast<double>(place.move.at(s)) +
                            double{place.way} * vec_cast<double>(place.direction.at(s)));
  }
  return depth;
}

void ContactSprings::press(const Place& place, Worker& worker) {
  const Range mine = worker.share(static_cast<int>(contacts_.size()));
  for (int i = mine.first; i < mine.last; ++i)
    if (stiffness_[i] > 0)
      force_[i] = static_cast<float>(double{stiffness_[i]} * std::max(0.0, depth_at(i, place)));
  worker.barrier();
}

void ContactSprings::add_force(int row, Row3 force) const {
  for (int at = row_starts_[row]; at < row_starts_[row + 1]; ++at) {
    Vec3f sum;
    for (const ContactUses::Use& use : uses_.of(at))
      sum += use.weight * force_[use.contact] * contacts_[use.contact].normal;
    const int col = uses_.samples()[at] - row * cloth_.size;
    force.x[col] += sum.x;
    force.y[col] += sum.y;
    force.z[col] += sum.z;
  }
}

void ContactSprings::add_blocks(int row, const std::array<float*, 6>& block) const {
  for (int at = row_starts_[row]; at < row_starts_[row + 1]; ++at) {
    const int col = uses_.samples()[at] - row * cloth_.size;
    for (const ContactUses::Use& use : uses_.of(at)) {
      const Contact& contact = contacts_[use.contact];
      const float k = stiffness_[use.contact] * sum_of_weights(contact) * std::abs(use.weight);
      const Vec3f n = contact.normal;
      block[0][col] += k * n.x * n.x;
      block[1][col] += k * n.x * n.y;
      block[2][col] += k * n.x * n.z;
      block[3][col] += k * n.y * n.y;
      block[4][col] += k * n.y * n.z;
      block[5][col] += k * n.z * n.z;
    }
  }
}

}  // namespace weft
