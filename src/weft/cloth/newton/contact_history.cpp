#include "weft/cloth/newton/contact_history.h"

#include <algorithm>
#include <array>
#include <tuple>

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
  sort();
}

void ContactHistory::restore(std::span<const PastContact> past) {
  past_.assign(past.begin(), past.end());
  next_.clear();
  sort();
}

void ContactHistory::sort() {
  entries_.clear();
  for (std::size_t i = 0; i < past_.size(); ++i)
    entries_.push_back({key_of(past_[i].samples, past_[i].second), static_cast<int>(i)});
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.key, a.index) < std::tie(b.key, b.index);
  });
}

const PastContact* ContactHistory::find(const Contact& contact, int second) const {
  if (entries_.empty()) return nullptr;
  const std::array<int, 4> samples = samples_of(contact);
  const std::uint64_t key = key_of(samples, second);
  auto entry = std::lower_bound(entries_.begin(), entries_.end(), key,
                                [](const Entry& e, std::uint64_t k) { return e.key < k; });
  const PastContact* best = nullptr;
  float closest = min_cosine;
  for (; entry != entries_.end() && entry->key == key; ++entry) {
    const PastContact& past = past_[entry->index];
    const float cosine = dot(past.normal, contact.normal);
    if (past.samples != samples || past.second != second || cosine < closest) continue;
    closest = cosine;
    best = &past;
  }
  return best;
}

}  // namespace weft
