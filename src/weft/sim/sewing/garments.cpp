#include "weft/sim/sewing/garments.h"

#include <algorithm>
#include <utility>

namespace weft {

bool Garments::any_sewn() const {
  for (std::size_t i = 0; i < cloths_.size(); ++i)
    if (is_sewn(i)) return true;
  return false;
}

double Garments::gravity_part(std::size_t cloth, double seconds) const {
  return is_sewn(cloth) ? sewing_[cloth]->gravity_part(seconds) : 1;
}

bool Garments::slides(std::size_t cloth, double seconds) const {
  if (!sewing_[cloth] || sewing_[cloth]->gravity_part(seconds) > 0) return false;
  return is_open(cloth) || fitted_[cloth] == 0;
}

void Garments::note_sliding(double seconds) {
  fitted_.resize(cloths_.size());
  sliding_.resize(cloths_.size());
  for (std::size_t i = 0; i < cloths_.size(); ++i) sliding_[i] = slides(i, seconds) ? 1 : 0;
}

bool Garments::join_closed(std::size_t cloth) {
  Cloth& model = *cloths_[cloth].model;
  const Planes3& position = cloths_[cloth].state.position;
  std::optional<BorderMates> apart;
  if (!sewing_[cloth]->is_closed(position)) apart = sewing_[cloth]->joined(position);
  const bool same = apart.has_value() == model.apart.has_value() &&
                    (!apart || apart->intervals() == model.apart->intervals());
  if (!same) model.apart = std::move(apart);
  return !same;
}

Garments::Changes Garments::begin_frame(double seconds, double length) {
  Changes changes;
  for (std::size_t i = 0; i < cloths_.size(); ++i) {
    if (!sewing_[i]) continue;
    sewing_[i]->begin_frame(cloths_[i].state.position, seconds, length);
    const bool joined = join_closed(i);
    if (fitted_[i] == 0 && !is_open(i) && !sewing_[i]->is_tight(cloths_[i].state.position))
      fitted_[i] = 1;
    const bool other_stage = slides(i, seconds) != is_sliding(i);
    if (other_stage) std::swap(cloths_[i].model->bending, other_bending_[i]);
    const double before = sewing_[i]->part_closed(seconds - length),
                 now = sewing_[i]->part_closed(seconds);
    const bool gathered = gathers_[i].gather(now, *cloths_[i].model);
    changes.work += gathers_[i].work(before, now, *cloths_[i].model, cloths_[i].state.position);
    changes.fabric = changes.fabric || other_stage || gathered;
    changes.contact = changes.contact || joined || other_stage;
  }
  return changes;
}

std::vector<double> Garments::gaps(std::size_t cloth) const {
  return sewing_[cloth] ? sewing_[cloth]->gaps(cloths_[cloth].state.position)
                        : std::vector<double>();
}

std::vector<double> Garments::stretches(std::size_t cloth) const {
  return sewing_[cloth] ? sewing_[cloth]->stretches(cloths_[cloth].state.position)
                        : std::vector<double>();
}

}  // namespace weft
