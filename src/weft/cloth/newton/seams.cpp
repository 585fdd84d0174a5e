#include "weft/cloth/newton/seams.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace weft {
namespace {

using EdgeGroup = std::vector<BorderEdge>;

/// Whether an edge of one group follows one of another on a line.
bool follows(const EdgeGroup& second, const EdgeGroup& first) {
  for (const BorderEdge& a : first)
    for (const BorderEdge& b : second)
      if (a.along_row == b.along_row && b.row == a.row + (a.along_row ? 0 : 1) &&
          b.col == a.col + (a.along_row ? 1 : 0))
        return true;
  return false;
}

/// The edges at a corner of a chart, along its first or last row and column.
std::array<BorderEdge, 2> edges_at_corner(const Chart& chart, bool last_row, bool last_col) {
  const int row = chart.row + (last_row ? chart.rows - 1 : 0),
            col = chart.col + (last_col ? chart.cols - 1 : 0);
  return {BorderEdge{true, row, last_col ? col - 1 : col},
          BorderEdge{false, last_row ? row - 1 : row, col}};
}

}  // namespace

Seams::Seams(const BorderMates& mates, const LevelLayout& layout) : size_(mates.size()) {
  std::vector<std::vector<int>> classes;
  for (int i = 0; i < mates.class_count(); ++i)
    if (const std::span<const int> copies = mates.copies(i); copies.size() > 1)
      classes.emplace_back(copies.begin(), copies.end());
  set_classes(classes, layout);
  hang({});
}

Seams::Seams(const CoarseSeams& coarse, const LevelLayout& layout) : size_(layout.size) {
  std::vector<std::vector<int>> classes = coarse.classes;
  std::vector<bool> has_class(static_cast<std::size_t>(size_) * size_, false);
  for (const std::vector<int>& one : classes)
    for (const int node : one) has_class[node] = true;
  for (const HangingNode& hanging : coarse.hanging)
    for (const HangingNode::Part& part : hanging.parts) {
      if (!has_class[part.node]) classes.push_back({part.node});
      has_class[part.node] = true;
    }
  std::sort(classes.begin(), classes.end());
  set_classes(classes, layout);
  hang(coarse.hanging);
}

void Seams::hang(const std::vector<HangingNode>& nodes) {
  hanging_ = nodes;
  std::map<int, std::vector<Hung>> from;
  for (const HangingNode& hanging : nodes)
    for (const HangingNode::Part& part : hanging.parts)
      from[part.node].push_back({hanging.node, place_of(hanging.node), part.weight});
  for (int i = 0; i < class_count(); ++i) {
    for (const int s : samples(i))
      if (const auto found = from.find(s); found != from.end())
        hung_.insert(hung_.end(), found->second.begin(), found->second.end());
    hung_starts_.push_back(static_cast<int>(hung_.size()));
  }
}

void Seams::set_classes(const std::vector<std::vector<int>>& classes, const LevelLayout& layout) {
  for (const std::vector<int>& members : classes) {
    samples_.insert(samples_.end(), members.begin(), members.end());
    for (const int s : members) places_.push_back(place_of(s));
    starts_.push_back(static_cast<int>(samples_.size()));
    inverse_count_.push_back(1 / static_cast<float>(members.size()));
  }
  find_edges(layout);
}

void Seams::find_edges(const LevelLayout& layout) {
  const int n = size_;
  std::map<int, int> first_copy;
  for (int i = 0; i < class_count(); ++i)
    for (const int s : samples(i)) first_copy[s] = samples(i).front();
  const auto particle = [&](int s) {
    const auto found = first_copy.find(s);
    return found == first_copy.end() ? s : found->second;
  };
  std::map<std::pair<int, int>, EdgeGroup> groups;
  const auto ends_of = [&](const BorderEdge& edge) {
    const int s = edge.row * n + edge.col;
    const int a = particle(s), b = particle(edge.along_row ? s + 1 : s + n);
    return std::pair(std::min(a, b), std::max(a, b));
  };
  const auto add = [&](const BorderEdge& edge) {
    const auto ends = ends_of(edge);
    if (ends.first != ends.second) groups[ends].push_back(edge);
  };
  for (const Chart& chart : layout.charts)
    for (int i = 0; i + 1 < std::max(chart.rows, chart.cols); ++i)
      for (const bool last : {false, true}) {
        if (i + 1 < chart.cols) add({true, chart.row + (last ? chart.rows - 1 : 0), chart.col + i});
        if (i + 1 < chart.rows)
          add({false, chart.row + i, chart.col + (last ? chart.cols - 1 : 0)});
      }
  for (const Chart& chart : layout.charts)
    for (const auto& [last_row, last_col] : {std::pair(false, false), std::pair(false, true),
                                             std::pair(true, false), std::pair(true, true)}) {
      const auto [along, down] = edges_at_corner(chart, last_row, last_col);
      const auto one = groups.find(ends_of(along)), other = groups.find(ends_of(down));
      if (one == groups.end() || other == groups.end()) continue;
      if (one == other || follows(one->second, other->second) ||
          follows(other->second, one->second))
        std::erase(other->second, down);
    }
  for (auto& [ends, group] : groups)
    if (group.size() > 1 && !follows(group, group)) edges_.push_back(std::move(group));
}

/// Sets every copy of a class to value(plane, places of the copies, class).
template <class Value>
void Seams::set_copies(const Workers& workers, std::initializer_list<PaddedPlane*> planes,
                       const Value& value) const {
  const Range mine = workers.share(class_count());
  for (int i = mine.first; i < mine.last; ++i) {
    const std::span<const std::ptrdiff_t> places = places_of(i);
    for (PaddedPlane* plane : planes) {
      float* const first = plane->row(0);
      const float all = value(first, places, i);
      for (const std::ptrdiff_t place : places) first[place] = all;
    }
  }
}

namespace {

float sum_of(const float* plane, std::span<const std::ptrdiff_t> places) {
  float total = 0;
  for (const std::ptrdiff_t place : places) total += plane[place];
  return total;
}

}  // namespace

float Seams::hung(const float* plane, int index, const float* alike) const {
  float total = 0;
  for (const Hung& one : hung_from(index))
    total += one.weight * (plane[one.place] - (alike != nullptr ? alike[one.place] : 0));
  return total;
}

void Seams::interpolate(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  if (hanging_.empty()) return;
  workers.barrier();
  const Range mine = workers.share(static_cast<int>(hanging_.size()));
  for (int i = mine.first; i < mine.last; ++i)
    for (PaddedPlane* plane : planes) {
      float* const first = plane->row(0);
      float mean = 0;
      for (const HangingNode::Part& part : hanging_[i].parts)
        mean += part.weight * first[place_of(part.node)];
      first[place_of(hanging_[i].node)] = mean;
    }
}

void Seams::sum(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  set_copies(workers, planes,
             [this](const float* plane, std::span<const std::ptrdiff_t> places, int i) {
               return sum_of(plane, places) + hung(plane, i);
             });
  interpolate(workers, planes);
}

void Seams::sum_beside(const Workers& workers, const PaddedVectors& alike,
                       PaddedVectors& field) const {
  const auto sum = [&](const PaddedPlane& given, PaddedPlane& plane) {
    const float* const known = given.row(0);
    set_copies(
        workers, {&plane}, [&](const float* first, std::span<const std::ptrdiff_t> places, int i) {
          const auto others = static_cast<float>(places.size() - 1);
          return sum_of(first, places) - others * known[places.front()] + hung(first, i, known);
        });
  };
  sum(alike.x, field.x);
  sum(alike.y, field.y);
  sum(alike.z, field.z);
  interpolate(workers, {&field.x, &field.y, &field.z});
}

void Seams::sum(const Workers& workers, int count, PlaneSet& planes, float* kept) const {
  const Range mine = workers.share(class_count());
  float* own = kept + std::ptrdiff_t{starts_[mine.first]} * count;
  for (int i = mine.first; i < mine.last; ++i)
    for (int k = 0; k < count; ++k) {
      float total = 0;
      for (const int s : samples(i)) total += * own++ = planes(s / size_, s % size_, k);
      for (const Hung& one : hung_from(i))
        total += one.weight * one.weight * planes(one.sample / size_, one.sample % size_, k);
      for (const int s : samples(i)) planes(s / size_, s % size_, k) = total;
    }
}

void Seams::restore(const Workers& workers, int count, const float* kept, PlaneSet& planes) const {
  const Range mine = workers.share(class_count());
  const float* own = kept + std::ptrdiff_t{starts_[mine.first]} * count;
  for (int i = mine.first; i < mine.last; ++i)
    for (int k = 0; k < count; ++k)
      for (const int s : samples(i)) planes(s / size_, s % size_, k) = *own++;
}

void Seams::average(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  set_copies(workers, planes,
             [this](const float* plane, std::span<const std::ptrdiff_t> places, int i) {
               return inverse_count_[i] * sum_of(plane, places);
             });
  interpolate(workers, planes);
}

void Seams::copy(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  set_copies(workers, planes, [](const float* plane, std::span<const std::ptrdiff_t> places, int) {
    return plane[places.front()];
  });
  interpolate(workers, planes);
}

void Seams::share(const Workers& workers, std::initializer_list<PaddedPlane*> planes) const {
  const Range mine = workers.share(class_count());
  for (int i = mine.first; i < mine.last; ++i)
    for (PaddedPlane* plane : planes)
      for (const std::ptrdiff_t place : places_of(i)) plane->row(0)[place] *= inverse_count_[i];
  const Range without = workers.share(static_cast<int>(hanging_.size()));
  for (int i = without.first; i < without.last; ++i)
    for (PaddedPlane* plane : planes) plane->row(0)[place_of(hanging_[i].node)] = 0;
}

}  // namespace weft
