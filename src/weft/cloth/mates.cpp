#include "weft/cloth/mates.h"

namespace weft {
namespace {

float& at(Grid<float>& plane, int sample) {
  return plane.row(sample / plane.cols())[sample % plane.cols()];
}

float sum_of(Grid<float>& plane, std::span<const int> samples) {
  float sum = 0;
  for (const int sample : samples) sum += at(plane, sample);
  return sum;
}

float mean_of(Grid<float>& plane, std::span<const int> samples) {
  return sum_of(plane, samples) / static_cast<float>(samples.size());
}

/// Sets each class of each plane to value(plane, its samples).
template <class Value>
void set_classes(const BorderMates& mates, Range mine, std::initializer_list<Grid<float>*> planes,
                 const Value& value) {
  for (int index = mine.first; index < mine.last; ++index) {
    const std::span<const int> samples = mates.mates(index);
    for (Grid<float>* plane : planes) {
      const float all = value(*plane, samples);
      for (const int sample : samples) at(*plane, sample) = all;
    }
  }
}

}  // namespace

void sum_over_mates(const BorderMates& mates, Worker& worker,
                    std::initializer_list<Grid<float>*> planes) {
  set_classes(mates, worker.share(mates.class_count()), planes, sum_of);
}

void sum_over_mates(const BorderMates& mates, std::initializer_list<Grid<float>*> planes) {
  set_classes(mates, {0, mates.class_count()}, planes, sum_of);
}

void average_over_mates(const BorderMates& mates, Worker& worker,
                        std::initializer_list<Grid<float>*> planes) {
  set_classes(mates, worker.share(mates.class_count()), planes, mean_of);
}

void average_over_mates(const BorderMates& mates, std::initializer_list<Grid<float>*> planes) {
  set_classes(mates, {0, mates.class_count()}, planes, mean_of);
}

void copy_to_mates(const BorderMates& mates, Worker& worker,
                   std::initializer_list<Grid<float>*> planes) {
  set_classes(
      mates, worker.share(mates.class_count()), planes,
      [](Grid<float>& plane, std::span<const int> samples) { return at(plane, samples.front()); });
}

}  // namespace weft
