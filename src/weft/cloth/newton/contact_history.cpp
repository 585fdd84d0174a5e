#include "weft/cloth/newton/contact_history.h"

#include <array>
#include <bit>

namespace weft {
namespace {

/// Smallest cosine between the normals of contacts that count as the same: an angle of 45 degrees.
constexpr float min_cosine = 0.7F;

std::array<int, 4> samples_of(const Contact& contact) {
  std::array<int, 4> samples{};
  for (std::size_t k = 0; k < samples.size(); ++k)
    samples[k] = contact.weights[k] == 0 ? -1 : contact.samples[k];
  return samples;
}

std::uint64_t key_of(const std::array<int, 4>& samples, int second) {
  std::uint64_t key = static_cast<std::uint32_t>(second);
  for (const int sample : samples) {
    key = (key ^ static_cast<std::uint32_t>(sample)) * 0x9E3779B97F4A7C15ULL;
    key ^= key >> 29;
  }
  return key;
}

std::uint32_t tag_of(std::uint64_t key) { return static_cast<std::uint32_t>(key >> 32); }

}  // namespace

void ContactHistory::add(const Contact& contact, int second, const PastContact& done) {
  PastContact& added = next_.emplace_back(done);
  added.samples = samples_of(contact);
  added.second = second;
  added.normal = contact.normal;
}

void ContactHistory::accept() {
  past_.swap(next_);
  next_.clear();
  hash_all();
}

void ContactHistory::restore(std::span<const PastContact> past) {
  past_.assign(past.begin(), past.end());
  next_.clear();
  hash_all();
}

void ContactHistory::hash_all() {
  slots_.assign(std::bit_ceil(2 * past_.size() + 1), {});
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = 0; i < past_.size(); ++i) {
    const std::uint64_t key = key_of(past_[i].samples, past_[i].second);
    std::size_t place = key & mask;
    while (slots_[place].index >= 0) place = (place + 1) & mask;
    slots_[place] = {tag_of(key), static_cast<int>(i)};
  }
}

const PastContact* ContactHistory::find(const Contact& contact, int second) const {
  if (past_.empty()) return nullptr;
  const std::array<int, 4> samples = samples_of(contact);
  const std::uint64_t key = key_of(samples, second);
  const PastContact* best = nullptr;
  float closest = min_cosine;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t place = key & mask; slots_[place].index >= 0; place = (place + 1) & mask) {
    if (slots_[place].tag != tag_of(key)) continue;
    const PastContact& past = past_[slots_[place].index];
    const float cosine = dot(past.normal, contact.normal);
    if (past.samples != samples || past.second != second || cosine < closest) continue;
    closest = cosine;
    best = &past;
  }
  return best;
}

}  // namespace weft
