#include "weft/cloth/integrate/contact_loads.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

float sum_of_weights(const Contact& contact) {
  float sum = 0;
  for (const float w : contact.weights) sum += std::abs(w);
  return sum;
}

}  // namespace

ContactLoads::ContactLoads(const Cloth& cloth)
    : cloth_(cloth),
      class_at_(static_cast<std::size_t>(4) * (cloth.size - 1), -1),
      uses_(cloth.size * cloth.size),
      row_starts_(static_cast<std::size_t>(cloth.size) + 1),
      rows_(static_cast<std::size_t>(cloth.size)) {
  for (int index = 0; index < cloth.mates.class_count(); ++index)
    for (const int sample : cloth.mates.mates(index))
      class_at_[border_position(cloth.size, sample)] = index;
}

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

void ContactLoads::use(int sample, ContactUses::Use use) {
  const int position = border_position(cloth_.size, sample);
  const int index = position < 0 ? -1 : class_at_[position];
  if (index < 0) return uses_.add(sample, use);
  const std::span<const int> samples = cloth_.mates.mates(index);
  use.weight /= static_cast<float>(samples.size());
  for (const int s : samples) uses_.add(s, use);
}

void ContactLoads::take(std::span<const Contact> contacts) {
  contacts_ = contacts;
  stiffness_.assign(contacts.size(), 0.0F);
  grip_.assign(contacts.size(), 0.0F);
  load_.assign(contacts.size(), Vec3f{});
  std::fill(rows_.begin(), rows_.end(), char{0});
  stiff_ = 0;
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

void ContactLoads::count(Worker& worker) {
  worker.barrier();
  if (worker.rank() == 0)
    stiff_ = static_cast<int>(std::count_if(stiffness_.begin(), stiffness_.end(),
                                            [](float stiffness) { return stiffness > 0; }));
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    rows_[r] = 0;
    for (int at = row_starts_[r]; at < row_starts_[r + 1] && rows_[r] == 0; ++at)
      for (const ContactUses::Use& use : uses_.of(at))
        if (stiffness_[use.contact] > 0) rows_[r] = 1;
  }
  worker.barrier();
}

void ContactLoads::add_row(int row, Row3 out) const {
  for (int at = row_starts_[row]; at < row_starts_[row + 1]; ++at) {
    Vec3f sum;
    for (const ContactUses::Use& use : uses_.of(at)) sum += use.weight * load_[use.contact];
    const int col = uses_.samples()[at] - row * cloth_.size;
    out.x[col] += sum.x;
    out.y[col] += sum.y;
    out.z[col] += sum.z;
  }
}

void ContactLoads::add_blocks(int row, const std::array<float*, 6>& block) const {
  for (int at = row_starts_[row]; at < row_starts_[row + 1]; ++at) {
    const int col = uses_.samples()[at] - row * cloth_.size;
    for (const ContactUses::Use& use : uses_.of(at)) {
      const Contact& contact = contacts_[use.contact];
      const float part = sum_of_weights(contact) * std::abs(use.weight);
      const float grip = part * grip_[use.contact];
      const float k = part * stiffness_[use.contact] - grip;
      const Vec3f n = contact.normal;
      block[0][col] += k * n.x * n.x + grip;
      block[1][col] += k * n.x * n.y;
      block[2][col] += k * n.x * n.z;
      block[3][col] += k * n.y * n.y + grip;
      block[4][col] += k * n.y * n.z;
      block[5][col] += k * n.z * n.z + grip;
    }
  }
}

}  // namespace weft
