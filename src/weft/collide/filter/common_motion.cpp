#include "weft/collide/filter/common_motion.h"

#include <algorithm>

#include "weft/mesh/box_tree.h"

namespace weft {
namespace {

/// Points move alike while the root of their mean squared distance from the mean displacement is
/// at most this part of it.
constexpr double max_mean_spread = 0.25;

}  // namespace

void CommonMotion::Displacements::add(Vec3d start, Vec3d end) {
  ++count;
  sum += end - start;
  squares += squared_length(end - start);
  box.add(start);
  box.add(end);
}

void CommonMotion::Displacements::add(const Displacements& others) {
  count += others.count;
  pinned = pinned || others.pinned;
  sum += others.sum;
  squares += others.squares;
}

Vec3d CommonMotion::Displacements::common() const {
  if (pinned) return {};
  const Vec3d mean = (1.0 / count) * sum;
  const double spread = squares / count - squared_length(mean);
  return spread <= max_mean_spread * max_mean_spread * squared_length(mean) ? mean : Vec3d{};
}

void CommonMotion::add(const MovingCloth& cloth, const SurfaceGrid& grid) {
  Displacements all;
  const int n = grid.size();
  for (int s = 0; s < n * n; ++s) {
    if (grid.point(s) != s) continue;
    all.add(vec_cast<double>(cloth.start.at(s)), vec_cast<double>(cloth.position.at(s)));
    all.pinned = all.pinned || cloth.inverse_mass(s / n, s % n) == 0;
  }
  cloths_.push_back(all);
}

void CommonMotion::find(double far_apart) {
  double farthest = 0;
  for (const Displacements& cloth : cloths_)
    farthest = std::max(farthest, length(cloth.sum) / cloth.count);
  join_near(far_apart * farthest);
  share();
}

bool CommonMotion::any() const {
  return std::any_of(translations_.begin(), translations_.end(),
                     [](Vec3d translation) { return translation != Vec3d{}; });
}

void CommonMotion::join_near(double distance) {
  const int count = static_cast<int>(cloths_.size());
  sets_.reset(count);
  const Vec3d margin{distance, distance, distance};
  for (int i = 0; i < count; ++i) {
    const Box3d around{cloths_[i].box.lower - margin, cloths_[i].box.upper + margin};
    for (int j = i + 1; j < count; ++j)
      if (overlap(around, cloths_[j].box)) sets_.join(i, j);
  }
}

void CommonMotion::share() {
  const int count = static_cast<int>(cloths_.size());
  for (int i = 0; i < count; ++i)
    if (const int root = sets_.root(i); root != i) cloths_[root].add(cloths_[i]);
  translations_.clear();
  for (int i = 0; i < count; ++i) translations_.push_back(cloths_[sets_.root(i)].common());
}

}  // namespace weft
