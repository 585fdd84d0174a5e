#include "weft/cloth/newton/contact_system.h"

#include <algorithm>
#include <cmath>

#include "weft/core/contact_point.h"

namespace weft {
namespace {

/// Contact stiffness over the stiffness by which the cloth holds the contact's point.
constexpr double relative_stiffness = 0.125;
/// Largest speed at which a point that is too close is lifted to its contact distance, too slow to
/// be seen. [m/s]
constexpr double lifting_speed = 0.02;

}  // namespace

ContactSystem::ContactSystem(std::span<const Cloth* const> cloths)
    : cloths_(cloths.begin(), cloths.end()), product_(cloths) {
  inverse_diagonals_.reserve(cloths.size());
  for (const Cloth* cloth : cloths) {
    inverse_diagonals_.emplace_back(cloth->size, cloth->size);
    held_.push_back(&inverse_diagonals_.back());
    loose_.push_back(&cloth->inverse_mass);
  }
}

void ContactSystem::clear() {
  contacts_.clear();
  places_.clear();
  starts_.clear();
  histories_.clear();
  firsts_.clear();
  product_.clear();
  product_.finish();
  active_ = 0;
  first_ = true;
  shared_ = false;
  obstructed_.assign(cloths_.size(), 0);
}

void ContactSystem::add(const Contact& contact, const std::array<int, 4>& cloths) {
  std::array<Place, 4> places{};
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (contact.weights[k] == 0) continue;
    const int n = cloths_[cloths[k]]->size, sample = contact.samples[k];
    places[k] = {cloths[k], sample / n, sample % n};
  }
  contacts_.push_back(contact);
  places_.push_back(places);
}

void ContactSystem::set_contacts(std::span<const Own> own, std::span<const SharedContact> shared,
                                 const StepInput& input) {
  clear();
  input_ = input;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const int cloth = static_cast<int>(i);
    starts_.push_back(own[i].start);
    histories_.push_back(own[i].history);
    firsts_.push_back(contacts_.size());
    for (const Contact& contact : own[i].contacts) add(contact, {cloth, cloth, cloth, cloth});
  }
  firsts_.push_back(contacts_.size());
  for (const SharedContact& one : shared)
    add(one.contact, {one.cloth_of(0), one.cloth_of(1), one.cloth_of(2), one.cloth_of(3)});
  const std::size_t count = contacts_.size();
  depth_.resize(count);
  lift_.resize(count);
  slid_.resize(count);
  energy_.resize(count);
  changed_.assign(count, 0);
  work_stiffness_.assign(count, 0.0F);
  stiffness_.assign(count, 0.0F);
  grip_.assign(count, 0.0F);
  force_.assign(count, 0.0F);
  limiting_.assign(count, 0.0F);
  friction_.assign(count, Vec3f{});
  acceleration_.assign(count, 0.0F);
  moved_.assign(count, Vec3d{});
  worked_.assign(count, 0.0);
  first_slip_.assign(count, 0.0);
  past_.assign(count, nullptr);
  gained_.assign(count, Vec3f{});
  touched_.assign(count, 0);
}

std::span<const float> ContactSystem::forces(std::size_t cloth) const {
  return std::span(force_).subspan(firsts_[cloth], firsts_[cloth + 1] - firsts_[cloth]);
}

Vec3d ContactSystem::sum(int index, Fields fields) const {
  Vec3d total;
  for (std::size_t k = 0; k < 4; ++k) {
    const double w = contacts_[index].weights[k];
    if (w == 0) continue;
    const Place& at = places_[index][k];
    const PaddedVectors& field = *fields[at.cloth];
    total += w * Vec3d{field.x(at.row, at.col), field.y(at.row, at.col), field.z(at.row, at.col)};
  }
  return total;
}

/// Displacement of the contact's point per unit of force, from the compliance of each sample.
double ContactSystem::compliance(int index, std::span<const Grid<float>* const> softness) const {
  PointCompliance total;
  for (std::size_t k = 0; k < 4; ++k) {
    const double w = contacts_[index].weights[k];
    if (w == 0) continue;
    const Place& at = places_[index][k];
    total.add(w, (*softness[at.cloth])(at.row, at.col));
  }
  return total.value();
}

/// The offset that the step may reach: the exit from a penetration at its start has a bounded
/// speed.
/// @param start_height  of its point along its normal
double ContactSystem::attainable_offset(int index, double start_height) const {
  const Contact& contact = contacts_[index];
  const double farthest = max_exit_speed * input_.time_step;
  const double before = double{contact.offset} - start_height -
                        double{dot(contact.normal, contact.surface_displacement)};
  return contact.offset - (before > farthest ? before - farthest : 0) + lift_[index];
}

void ContactSystem::hold(std::size_t cloth, const PlaneSet& diagonal, const Worker& worker) {
  const Cloth& one = *cloths_[cloth];
  Grid<float>& inverse = inverse_diagonals_[cloth];
  const Range rows = worker.share(one.size);
  for (int r = rows.first; r < rows.last; ++r)
    for (int c = 0; c < one.size; ++c) {
      const float trace = diagonal(r, c, 0) + diagonal(r, c, 3) + diagonal(r, c, 5);
      inverse(r, c) = one.inverse_mass(r, c) > 0 ? 3 / trace : 0;
    }
}

void ContactSystem::place(Fields position, Worker& worker) {
  worker.barrier();
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    const Contact& contact = contacts_[i];
    const bool soft = contact.stiffness > 0;
    const double yields = compliance(i, held_);
    work_stiffness_[i] =
        soft         ? contact.stiffness
        : yields > 0 ? static_cast<float>(contact.firmness * relative_stiffness * (1 / yields))
                     : 0.0F;
    lift_[i] = soft ? 0 : std::min(double{contact.lift}, lifting_speed * input_.time_step);
    if (first_) recall(i);
    locate(i, position);
  }
  worker.barrier();
}

double ContactSystem::depth_after(int index, Vec3d step) const {
  return depth_[index] - dot(vec_cast<double>(contacts_[index].normal), step);
}

Vec3d ContactSystem::slid_after(int index, Vec3d step) const {
  const Vec3d normal = vec_cast<double>(contacts_[index].normal);
  return slid_[index] + step - dot(normal, step) * normal;
}

double ContactSystem::lone_compliance(int index) const {
  return compliance(index, loose_) * input_.time_step * input_.time_step;
}

/// Weights of contacts between cloth and cloth sum to 0, others to 1.
bool ContactSystem::is_with_obstacle(std::size_t index) const {
  const auto& weights = contacts_[index].weights;
  return (weights[0] + weights[1]) + (weights[2] + weights[3]) > 0.5F;
}

void ContactSystem::count_holds() {
  std::fill(obstructed_.begin(), obstructed_.end(), char{0});
  shared_ = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!(stiffness_[i] > 0)) continue;
    if (i >= firsts_.back())
      shared_ = true;
    else if (is_with_obstacle(i))
      obstructed_[places_[i][0].cloth] = 1;
  }
}

void ContactSystem::pack_one(int index) {
  const Contact& contact = contacts_[index];
  ContactProduct::Spring spring{contact.samples,   contact.weights, contact.normal,
                                stiffness_[index], grip_[index],    {}};
  for (std::size_t k = 4; k-- > 0;)
    if (contact.weights[k] != 0)
      spring.cloths[contact.weights[k] < 0 ? 1 : 0] = places_[index][k].cloth;
  if (is_with_obstacle(static_cast<std::size_t>(index))) spring.cloths[1] = spring.cloths[0];
  product_.add(spring);
}

/// Packs the contacts that are active or were before the last choice.
void ContactSystem::pack(Worker& worker) {
  worker.barrier();
  if (worker.rank() == 0) {
    product_.clear();
    const int count = static_cast<int>(contacts_.size());
    for (int i = 0; i < count; ++i)
      if (touched_[i] != 0) pack_one(i);
    product_.finish();
    for (int i = 0, packed = 0; i < count; ++i)
      if (touched_[i] != 0) product_.set_load(packed++, gained_[i]);
    active_ = static_cast<int>(
        std::count_if(stiffness_.begin(), stiffness_.end(), [](float k) { return k > 0; }));
    any_changed_ = std::find(changed_.begin(), changed_.end(), 1) != changed_.end();
    first_ = false;
    count_holds();
  }
  worker.barrier();
}

bool ContactSystem::choose(const Fields* step, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    if (step == nullptr) {
      worked_[i] = 0;
      moved_[i] = {};
      choose(i, {}, {});
    } else {
      const Vec3d moved = sum(i, *step);
      worked_[i] += work_since_choice(i, moved);
      moved_[i] = moved;
      choose(i, moved, force_after(i, moved));
    }
  }
  pack(worker);
  return any_changed_;
}

bool ContactSystem::any_layer_passed(Fields step, double speed, Worker& worker) {
  const Range mine = share(worker);
  const double most = speed * input_.time_step;
  for (int i = mine.first; i < mine.last; ++i) {
    const bool idle = !(stiffness_[i] > 0) && work_stiffness_[i] > 0;
    changed_[i] = idle && !is_with_obstacle(static_cast<std::size_t>(i)) &&
                          depth_after(i, sum(i, step)) > most
                      ? 1
                      : 0;
  }
  worker.barrier();
  const bool any = std::find(changed_.begin(), changed_.end(), 1) != changed_.end();
  worker.barrier();
  return any;
}

/// @param moved  the displacement of its point since the linearisation
Vec3d ContactSystem::force_after(int index, Vec3d moved) const {
  const double k = stiffness_[index], grip = grip_[index];
  if (!(k > 0)) return {};
  return k * depth_after(index, moved) * vec_cast<double>(contacts_[index].normal) -
         grip * slid_after(index, moved);
}

/// Forces are linear in the displacement between two choices.
double ContactSystem::work_since_choice(int index, Vec3d moved) const {
  const Vec3d mean = 0.5 * (force_after(index, moved_[index]) + force_after(index, moved));
  return dot(mean, moved - moved_[index]);
}

double ContactSystem::sum_of_energies(Worker& worker) {
  worker.barrier();
  double total = 0;
  for (const double one : energy_) total += one;
  worker.barrier();
  return total;
}

double ContactSystem::work_on_cloths(Fields step, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i)
    energy_[i] = worked_[i] + work_since_choice(i, sum(i, step));
  return sum_of_energies(worker);
}

double ContactSystem::work(Fields step, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    const Vec3f surface_displacement = contacts_[i].surface_displacement;
    energy_[i] = surface_displacement == Vec3f{}
                     ? 0
                     : dot(force_after(i, sum(i, step)), vec_cast<double>(surface_displacement));
  }
  return sum_of_energies(worker);
}

Vec3d ContactSystem::obstacle_force(Fields step, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i)
    if (stiffness_[i] > 0) gained_[i] = vec_cast<float>(force_after(i, sum(i, step)));
  worker.barrier();
  Vec3d total;
  for (std::size_t i = 0; i < gained_.size(); ++i)
    if (stiffness_[i] > 0 && is_with_obstacle(i)) total += vec_cast<double>(gained_[i]);
  worker.barrier();
  return total;
}

double ContactSystem::energy(Fields step, float part, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    const Vec3d moved = double{part} * sum(i, step);
    const double depth = std::max(0.0, depth_after(i, moved)), grip = grip_[i];
    energy_[i] = 0.5 * (double{work_stiffness_[i]} * depth * depth +
                        grip * squared_length(slid_after(i, moved)));
  }
  return sum_of_energies(worker);
}

}  // namespace weft
