#include "weft/cloth/newton/contact_system.h"

#include <algorithm>
#include <cmath>

namespace weft {
namespace {

/// Times what the cloth's own springs hold the contact's point by.
constexpr double relative_stiffness = 0.125;
/// And along the surface where it sticks, times that: soft enough for what rounding does to
/// positions, at a spring of 1 m and more a tenth of a micrometre, to be small beside friction.
constexpr double sticking_stiffness = 0.1;
/// Of a contact's force in the limit of its friction; the rest is what the limit was before, as
/// forces tremble with rounding, too.
constexpr double new_force_part = 0.5;
/// Limits of friction that differ by this part of them are alike.
constexpr double same_grip = 0.03;
/// What is inside something when a step begins, having been put or pressed there, leaves at this
/// speed at most, lest it be shot out. [m/s]
constexpr double fastest_way_out = 0.5;
/// What stands nearer than it should rises at this speed at most, which nobody sees. [m/s]
constexpr double lifting_speed = 0.02;

}  // namespace

ContactSystem::ContactSystem(std::span<const Cloth* const> cloths)
    : cloths_(cloths.begin(), cloths.end()) {
  inverse_diagonals_.reserve(cloths.size());
  for (const Cloth* cloth : cloths) {
    gathers_.emplace_back(*cloth);
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
  for (ContactGather& gather : gathers_) gather.clear();
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
    gathers_[cloths[k]].add(sample, static_cast<int>(contacts_.size()), contact.weights[k]);
  }
  contacts_.push_back(contact);
  places_.push_back(places);
}

void ContactSystem::take(std::span<const Own> own, std::span<const SharedContact> shared,
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
  for (ContactGather& gather : gathers_) gather.finish();
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
  first_way_.assign(count, 0.0);
  past_.assign(count, nullptr);
  load_.assign(count, Vec3f{});
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

Vec3d ContactSystem::start_of(int index) const {
  Vec3d point;
  for (std::size_t k = 0; k < 4; ++k) {
    const double w = contacts_[index].weights[k];
    if (w == 0) continue;
    const Place& at = places_[index][k];
    point += w * vec_cast<double>(starts_[at.cloth]->at(at.row, at.col));
  }
  return point;
}

/// How far the point gives way to a force, where samples do by the softness of each.
double ContactSystem::compliance(int index, std::span<const Grid<float>* const> softness) const {
  double total = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double w = contacts_[index].weights[k];
    if (w == 0) continue;
    const Place& at = places_[index][k];
    total += w * w * double{(*softness[at.cloth])(at.row, at.col)};
  }
  return total;
}

/// The offset that the step may bring about.
double ContactSystem::attainable_offset(int index) const {
  const Contact& contact = contacts_[index];
  const double farthest = fastest_way_out * input_.time_step;
  const double before = double{contact.offset} -
                        dot(vec_cast<double>(contact.normal), start_of(index)) -
                        double{dot(contact.normal, contact.slide)};
  return contact.offset - (before > farthest ? before - farthest : 0);
}

void ContactSystem::hold(std::size_t cloth, const PaddedBlocks& diagonal, const Worker& worker) {
  const Cloth& one = *cloths_[cloth];
  Grid<float>& inverse = inverse_diagonals_[cloth];
  const Range rows = worker.share(one.size);
  for (int r = rows.first; r < rows.last; ++r)
    for (int c = 0; c < one.size; ++c) {
      const float trace =
          diagonal.entry[0](r, c) + diagonal.entry[3](r, c) + diagonal.entry[5](r, c);
      inverse(r, c) = one.inverse_mass(r, c) > 0 ? 3 / trace : 0;
    }
}

int ContactSystem::second_of(std::size_t index) const {
  if (index < firsts_.back()) return -1;
  int first = -1, second = -1;
  for (std::size_t k = 0; k < 4; ++k)
    if (contacts_[index].weights[k] != 0)
      (contacts_[index].weights[k] < 0 ? second : first) = places_[index][k].cloth;
  return second;
}

/// Looks for it among those of the last step.
void ContactSystem::recall(int index) {
  const auto positive = [&](std::size_t k) { return contacts_[index].weights[k] > 0; };
  std::size_t k = 0;
  while (k < 3 && !positive(k)) ++k;
  const ContactHistory* history = histories_[places_[index][k].cloth];
  if (history != nullptr)
    past_[index] = history->find(contacts_[index], second_of(static_cast<std::size_t>(index)));
}

/// Where positions have led the point since the step's start. Of positions, not of velocities: what
/// rounding does to them each step would add up to creep.
Vec3d ContactSystem::way_to(int index, Fields position) const {
  Vec3d way;
  for (std::size_t k = 0; k < 4; ++k) {
    const double w = contacts_[index].weights[k];
    if (w == 0) continue;
    const Place& at = places_[index][k];
    const PaddedVectors& x = *position[at.cloth];
    const Vec3f now{x.x(at.row, at.col), x.y(at.row, at.col), x.z(at.row, at.col)};
    way += w * (vec_cast<double>(now) - vec_cast<double>(starts_[at.cloth]->at(at.row, at.col)));
  }
  return way;
}

void ContactSystem::locate(int index, Fields position) {
  const Contact& contact = contacts_[index];
  const Vec3d normal = vec_cast<double>(contact.normal), way = way_to(index, position);
  const double offset =
      contact.stiffness > 0 ? double{contact.offset} : attainable_offset(index) + lift_[index];
  depth_[index] = offset - dot(normal, start_of(index)) - dot(normal, way);
  Vec3d relative = way - vec_cast<double>(contact.slide);
  // Friction that was there has stretched what sticks.
  if (past_[index] != nullptr && work_stiffness_[index] > 0)
    relative -= 1 / (sticking_stiffness * double{work_stiffness_[index]}) *
                vec_cast<double>(past_[index]->friction);
  slid_[index] = relative - dot(normal, relative) * normal;
}

void ContactSystem::place(Fields position, Worker& worker) {
  worker.barrier();
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    const Contact& contact = contacts_[i];
    const bool soft = contact.stiffness > 0;
    const double yields = compliance(i, held_);
    work_stiffness_[i] = soft         ? contact.stiffness
                         : yields > 0 ? static_cast<float>(relative_stiffness * (1 / yields))
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

/// What friction can hold sticks. Else it drags with its whole force where the point is, or, of a
/// new contact, where that lets it come to: its way less what the force takes off it.
double ContactSystem::grip_for(int index, const Sliding& sliding) const {
  const double stiffness = sticking_stiffness * work_stiffness_[index];
  const double most = contacts_[index].friction * sliding.force;
  const double held = sliding.is_new ? most * lone_compliance(index) : 0;
  if (stiffness * (sliding.way - held) <= most) return stiffness;
  return most / (sliding.way - held);
}

/// What limits friction. @param pressed  by what it was held as the point came to that depth
double ContactSystem::limiting_force(int index, double depth, double pressed) const {
  const double now = pressed * std::max(0.0, depth), yields = lone_compliance(index);
  if (past_[index] != nullptr)
    return first_ ? double{past_[index]->force}
                  : now + (1 - new_force_part) * (double{past_[index]->force} - now);
  if (pressed > 0) return now;
  // A new one is taken to stop its own point alone.
  return yields > 0 ? std::max(0.0, depth - lift_[index]) / yields : 0;
}

/// How much farther than it flies on a slipping point will go, if it gains speed as it did: its
/// drag shall be right at the end of the step.
double ContactSystem::foreseen_way(int index, double way) const {
  if (past_[index] == nullptr) return 0;
  const double gained = past_[index]->acceleration * input_.time_step * input_.time_step;
  return std::clamp(gained, -0.5 * way, way);
}

bool ContactSystem::choose(int index, Fields step) {
  const Contact& contact = contacts_[index];
  float &k = stiffness_[index], &grip = grip_[index];
  const float k_before = k, grip_before = grip;
  const Vec3d moved = sum(index, step);
  const double depth = depth_after(index, moved);
  k = depth > 0 ? work_stiffness_[index] : 0.0F;
  const double force = limiting_force(index, depth, k_before);
  const bool is_new = past_[index] == nullptr && !(k_before > 0);
  double way = length(slid_after(index, moved));
  if (first_) {
    first_way_[index] = way;
    way += foreseen_way(index, way);
  }
  grip = k > 0 && contact.friction > 0 ? static_cast<float>(grip_for(index, {way, force, is_new}))
                                       : 0.0F;
  return (k > 0) != (k_before > 0) ||
         std::abs(grip - grip_before) > same_grip * std::max(grip, grip_before);
}

void ContactSystem::count_holds() {
  std::fill(obstructed_.begin(), obstructed_.end(), char{0});
  shared_ = false;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!(stiffness_[i] > 0)) continue;
    const auto& weights = contacts_[i].weights;
    const float sum = (weights[0] + weights[1]) + (weights[2] + weights[3]);
    if (i >= firsts_.back())
      shared_ = true;
    else if (sum > 0.5F)
      obstructed_[places_[i][0].cloth] = 1;
  }
}

void ContactSystem::count(Worker& worker) {
  worker.barrier();
  for (ContactGather& gather : gathers_) gather.mark_rows(stiffness_, worker);
  if (worker.rank() == 0) {
    active_ = static_cast<int>(
        std::count_if(stiffness_.begin(), stiffness_.end(), [](float k) { return k > 0; }));
    any_changed_ = std::find(changed_.begin(), changed_.end(), 1) != changed_.end();
    first_ = false;
    count_holds();
  }
  worker.barrier();
}

bool ContactSystem::choose(Fields step, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) changed_[i] = choose(i, step) ? 1 : 0;
  count(worker);
  return any_changed_;
}

Vec3d ContactSystem::force_after(int index, Fields step) const {
  const double k = stiffness_[index], grip = grip_[index];
  if (!(k > 0)) return {};
  const Vec3d moved = sum(index, step);
  return k * depth_after(index, moved) * vec_cast<double>(contacts_[index].normal) -
         grip * slid_after(index, moved);
}

void ContactSystem::load_forces(Fields step, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) load_[i] = vec_cast<float>(force_after(i, step));
  worker.barrier();
}

double ContactSystem::sum_of_energies(Worker& worker) {
  worker.barrier();
  double total = 0;
  for (const double one : energy_) total += one;
  worker.barrier();
  return total;
}

double ContactSystem::work(Fields step, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    const Vec3f slide = contacts_[i].slide;
    energy_[i] = slide == Vec3f{} ? 0 : dot(force_after(i, step), vec_cast<double>(slide));
  }
  return sum_of_energies(worker);
}

void ContactSystem::load_product(Fields direction, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    const double k = stiffness_[i], grip = grip_[i];
    Vec3d load;
    if (k > 0) {
      const Vec3d normal = vec_cast<double>(contacts_[i].normal), moved = sum(i, direction);
      load = (k - grip) * dot(normal, moved) * normal + grip * moved;
    }
    load_[i] = vec_cast<float>(load);
  }
  worker.barrier();
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

void ContactSystem::measure(Fields position, Worker& worker) {
  const Range mine = share(worker);
  for (int i = mine.first; i < mine.last; ++i) {
    locate(i, position);
    force_[i] = static_cast<float>(std::max(0.0, double{stiffness_[i]} * depth_[i]));
    limiting_[i] = static_cast<float>(limiting_force(i, depth_[i], stiffness_[i]));
    const Vec3d drag = -double{grip_[i]} * slid_[i];
    const double most = double{contacts_[i].friction} * limiting_[i], has = length(drag);
    friction_[i] = vec_cast<float>((has > most ? most / has : 1.0) * drag);
    const bool slips = grip_[i] < 0.99 * sticking_stiffness * work_stiffness_[i];
    const double h = input_.time_step;
    acceleration_[i] =
        slips ? static_cast<float>((length(slid_[i]) - first_way_[i]) / (h * h)) : 0.0F;
  }
  worker.barrier();
}

void ContactSystem::remember(std::size_t cloth, ContactHistory& history) const {
  const auto add = [&](std::size_t i, int second) {
    if (force_[i] > 0) {
      PastContact done;
      done.friction = friction_[i];
      done.force = limiting_[i];
      done.acceleration = acceleration_[i];
      history.add(contacts_[i], second, done);
    }
  };
  for (std::size_t i = firsts_[cloth]; i < firsts_[cloth + 1]; ++i) add(i, -1);
  for (std::size_t i = firsts_.back(); i < contacts_.size(); ++i) {
    const int second = second_of(i);
    bool is_first = false;
    for (std::size_t k = 0; k < 4; ++k)
      is_first = is_first ||
                 (contacts_[i].weights[k] > 0 && places_[i][k].cloth == static_cast<int>(cloth));
    if (is_first) add(i, second);
  }
}

}  // namespace weft
