#include "weft/cloth/newton/seams.h"

#include <algorithm>
#include <map>
#include <utility>

#include "weft/core/disjoint_sets.h"

namespace weft {
namespace {

float& at(PaddedPlane& plane, int n, int sample) { return plane(sample / n, sample % n); }

}  // namespace

Seams::Seams(const BorderMates& mates) : size_(mates.size()) {
  std::vector<std::vector<int>> classes;
  for (int i = 0; i < mates.class_count(); ++i)
    classes.emplace_back(mates.mates(i).begin(), mates.mates(i).end());
  set_classes(std::move(classes));
}

void Seams::set_classes(std::vector<std::vector<int>> classes) {
  for (const std::vector<int>& members : classes) {
    samples_.insert(samples_.end(), members.begin(), members.end());
    starts_.push_back(static_cast<int>(samples_.size()));
    inverse_count_.push_back(1 / static_cast<float>(members.size()));
  }
  find_edges();
}

void Seams::find_edges() {
  const int n = size_;
  std::map<int, int> first_copy;
  for (int i = 0; i < class_count(); ++i)
    for (const int s : samples(i)) first_copy[s] = samples(i).front();
  const auto particle = [&](int s) {
    const auto found = first_copy.find(s);
    return found == first_copy.end() ? s : found->second;
  };
  std::map<std::pair<int, int>, std::vector<BorderEdge>> groups;
  const auto add = [&](const BorderEdge& edge) {
    const int s = edge.row * n + edge.col;
    const int a = particle(s), b = particle(edge.along_row ? s + 1 : s + n);
    if (a != b) groups[std::minmax(a, b)].push_back(edge);
  };
  for (int i = 0; i + 1 < n; ++i)
    for (const int border : {0, n - 1}) {
      add({true, border, i});
      add({false, i, border});
    }
  for (auto& [ends, group] : groups)
    if (group.size() > 1) edges_.push_back(std::move(group));
}

Seams Seams::coarsened() const {
  const int n = size_, m = n / 2 + 1;
  const auto coarse_of = [&](int x) { return x == n - 1 ? m - 1 : x / 2; };
  const auto fine_of = [&](int x) { return std::min(2 * x, n - 1); };
  const auto coarse = [&](int s) { return coarse_of(s / n) * m + coarse_of(s % n); };
  const auto fine = [&](int s) { return fine_of(s / m) * n + fine_of(s % m); };
  DisjointSets sets(m * m);
  for (int i = 0; i < class_count(); ++i)
    for (const int a : samples(i)) {
      if (fine(coarse(a)) != a) continue;
      // A copy between two nodes is joined from one side only, or seams would become one node.
      for (const int b : samples(i))
        if (fine(coarse(b)) == b || a < b) sets.join(coarse(a), coarse(b));
    }
  std::vector<std::vector<int>> members(static_cast<std::size_t>(m) * m), classes;
  for (int s = 0; s < m * m; ++s) members[sets.root(s)].push_back(s);
  for (std::vector<int>& one : members)
    if (one.size() > 1) classes.push_back(std::move(one));
  Seams result;
  result.size_ = m;
  result.set_classes(std::move(classes));
  return result;
}

void Seams::sum(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  const Range mine = workers.share(class_count());
  for (int i = mine.first; i < mine.last; ++i)
    for (PaddedPlane* plane : planes) {
      float total = 0;
      for (const int s : samples(i)) total += at(*plane, size_, s);
      for (const int s : samples(i)) at(*plane, size_, s) = total;
    }
}

void Seams::average(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  const Range mine = workers.share(class_count());
  for (int i = mine.first; i < mine.last; ++i)
    for (PaddedPlane* plane : planes) {
      float total = 0;
      for (const int s : samples(i)) total += at(*plane, size_, s);
      for (const int s : samples(i)) at(*plane, size_, s) = inverse_count_[i] * total;
    }
}

void Seams::copy(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  const Range mine = workers.share(class_count());
  for (int i = mine.first; i < mine.last; ++i)
    for (PaddedPlane* plane : planes)
      for (const int s : samples(i).subspan(1))
        at(*plane, size_, s) = at(*plane, size_, samples(i).front());
}

void Seams::share(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  const Range mine = workers.share(class_count());
  for (int i = mine.first; i < mine.last; ++i)
    for (PaddedPlane* plane : planes)
      for (const int s : samples(i)) at(*plane, size_, s) *= inverse_count_[i];
}

}  // namespace weft
