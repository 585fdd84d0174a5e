#include "weft/cloth/baselines/contact_gather.h"

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

ContactGather::ContactGather(const Cloth& cloth)
    : cloth_(cloth),
      class_at_(static_cast<std::size_t>(cloth.size) * cloth.size, -1),
      uses_(cloth.size * cloth.size),
      row_starts_(static_cast<std::size_t>(cloth.size) + 1),
      rows_(static_cast<std::size_t>(cloth.size)) {
  for (int index = 0; index < cloth.mates.class_count(); ++index)
    for (const int sample : cloth.mates.mates(index))
      class_at_[static_cast<std::size_t>(sample)] = index;
}

void ContactGather::clear() {
  std::fill(rows_.begin(), rows_.end(), char{0});
  uses_.clear();
}

void ContactGather::add(int sample, int contact, float weight) {
  const int index = class_at_[static_cast<std::size_t>(sample)];
  if (index < 0) return uses_.add(sample, {contact, weight});
  const std::span<const int> samples = cloth_.mates.copies(index);
  for (const int s : samples) uses_.add(s, {contact, weight / static_cast<float>(samples.size())});
}

void ContactGather::finish() {
  uses_.finish();
  const std::span<const int> used = uses_.samples();
  int at = 0;
  for (int r = 0; r <= cloth_.size; ++r) {
    while (at < static_cast<int>(used.size()) && used[at] < r * cloth_.size) ++at;
    row_starts_[r] = at;
  }
}

void ContactGather::mark_rows(std::span<const float> stiffness, const Worker& worker) {
  const Range mine = worker.share(cloth_.size);
  for (int r = mine.first; r < mine.last; ++r) {
    rows_[r] = 0;
    for (int at = row_starts_[r]; at < row_starts_[r + 1] && rows_[r] == 0; ++at)
      for (const ContactUses::Use& use : uses_.of(at))
        if (stiffness[use.contact] > 0) rows_[r] = 1;
  }
}

bool ContactGather::any() const {
  return std::find(rows_.begin(), rows_.end(), char{1}) != rows_.end();
}

void ContactGather::add_row(int row, std::span<const Vec3f> loads, Row3 out) const {
  for (int at = row_starts_[row]; at < row_starts_[row + 1]; ++at) {
    Vec3f sum;
    for (const ContactUses::Use& use : uses_.of(at)) sum += use.weight * loads[use.contact];
    const int col = uses_.samples()[at] - row * cloth_.size;
    out.x[col] += sum.x;
    out.y[col] += sum.y;
    out.z[col] += sum.z;
  }
}

void ContactGather::add_blocks(int row, const Springs& springs,
                               const std::array<float*, 6>& block) const {
  for (int at = row_starts_[row]; at < row_starts_[row + 1]; ++at) {
    const int col = uses_.samples()[at] - row * cloth_.size;
    for (const ContactUses::Use& use : uses_.of(at)) {
      const Contact& contact = springs.contacts[use.contact];
      const float part = sum_of_weights(contact) * std::abs(use.weight);
      const float grip = part * springs.grip[use.contact];
      const float k = part * springs.stiffness[use.contact] - grip;
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
