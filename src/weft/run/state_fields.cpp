#include "weft/run/state_fields.h"

#include <algorithm>
#include <utility>

#include "weft/geometry_image.h"
#include "weft/sim/stepping/adaptive_substeps.h"

namespace weft {
namespace {

int samples_of(const ClothState& cloth) { return cloth.position.size() * cloth.position.size(); }

template <class State, class Visit>
void each_plane(State& state, const Visit& visit) {
  for (auto* planes : {&state.position, &state.velocity})
    for (auto* plane : {&planes->x, &planes->y, &planes->z}) visit(*plane);
}

void add_cloth(const ClothState& cloth, ByteWriter& out) {
  out.add(static_cast<std::int32_t>(cloth.position.size()));
  each_plane(cloth, [&](const Grid<float>& plane) {
    for (int r = 0; r < plane.rows(); ++r) out.add_floats(plane.row(r), plane.cols());
  });
}

/// Reads a cloth; nothing for a size that the bytes do not hold.
std::optional<ClothState> next_cloth(ByteReader& in) {
  const auto size = in.next<std::int32_t>();
  if (size < min_image_size || size > largest_image_size) return std::nullopt;
  const std::size_t samples = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  if (in.left() < 6 * sizeof(float) * samples) return std::nullopt;
  ClothState cloth{Planes3(size), Planes3(size)};
  each_plane(cloth, [&](Grid<float>& plane) {
    for (int r = 0; r < size; ++r) in.read_floats(plane.row(r), size);
  });
  return cloth;
}

void add_marks(const std::vector<int>& marks, ByteWriter& out) {
  out.add(static_cast<std::uint64_t>(marks.size()));
  for (const int mark : marks) out.add(static_cast<std::int32_t>(mark));
}

/// Reads marks; nothing for a count that does not fit the cloth, or an invalid mark.
std::optional<std::vector<int>> next_marks(std::size_t wanted, ByteReader& in) {
  const auto count = in.next<std::uint64_t>();
  if (count != 0 && count != wanted) return std::nullopt;
  if (in.left() < count * sizeof(std::int32_t)) return std::nullopt;
  std::vector<int> marks(static_cast<std::size_t>(count));
  for (int& mark : marks) {
    mark = in.next<std::int32_t>();
    if (mark < 0) return std::nullopt;
  }
  return marks;
}

/// Visits every field of a past contact in the order of the file.
template <class Past, class Visit>
void each_field_of_past(Past& past, const Visit& visit) {
  for (auto& sample : past.samples) visit(sample);
  visit(past.second);
  for (auto* v : {&past.normal, &past.friction}) visit(v->x), visit(v->y), visit(v->z);
  visit(past.force), visit(past.acceleration);
}
static_assert(sizeof(PastContact) == 13 * 4, "a new field goes into each_field_of_past");

void add_contacts(const std::vector<PastContact>& contacts, ByteWriter& out) {
  out.add(static_cast<std::uint64_t>(contacts.size()));
  for (const PastContact& past : contacts)
    each_field_of_past(past, [&](auto value) { out.add(value); });
}

/// Reads past contacts; nothing for a count that the bytes do not hold, or a sample that the cloth
/// has not. @param own, most  samples of the cloth, and of the largest one
std::optional<std::vector<PastContact>> next_contacts(int own, int most, ByteReader& in) {
  const auto count = in.next<std::uint64_t>();
  if (count > in.left() / sizeof(PastContact)) return std::nullopt;
  std::vector<PastContact> contacts(static_cast<std::size_t>(count));
  for (PastContact& past : contacts) {
    each_field_of_past(past, [&](auto& value) { in.read(value); });
    for (const int sample : past.samples)
      if (sample < -1 || sample >= (past.second < 0 ? own : most)) return std::nullopt;
  }
  return contacts;
}

/// Visits every field of a struck contact in the order of the file.
template <class Struck, class Visit>
void each_field_of_struck(Struck& struck, const Visit& visit) {
  auto& contact = struck.shared.contact;
  for (auto& sample : contact.samples) visit(sample);
  for (auto& weight : contact.weights) visit(weight);
  for (auto* v :
       {&contact.normal, &contact.surface_displacement, &struck.body_velocity, &struck.way})
    visit(v->x), visit(v->y), visit(v->z);
  visit(contact.offset), visit(contact.friction), visit(contact.lift), visit(contact.stiffness),
      visit(contact.firmness);
  visit(struck.shared.first), visit(struck.shared.second), visit(struck.body),
      visit(struck.compliance);
}
constexpr std::size_t struck_bytes = 28 * 4 + sizeof(double);
static_assert(sizeof(StruckContact) == struck_bytes + 8,  // of padding
              "a new field goes into each_field_of_struck, and this count up");

void add_struck(const std::vector<StruckContact>& contacts, ByteWriter& out) {
  out.add(static_cast<std::uint64_t>(contacts.size()));
  for (const StruckContact& struck : contacts)
    each_field_of_struck(struck, [&](auto value) { out.add(value); });
}

/// Reads struck contacts; nothing for a count that the bytes do not hold. Whether there are such
/// samples and bodies is seen where a run goes on with them.
std::optional<std::vector<StruckContact>> next_struck(ByteReader& in) {
  const auto count = in.next<std::uint64_t>();
  if (count > in.left() / struck_bytes) return std::nullopt;
  std::vector<StruckContact> contacts(static_cast<std::size_t>(count));
  for (StruckContact& struck : contacts)
    each_field_of_struck(struck, [&](auto& value) { in.read(value); });
  return contacts;
}

/// Each cloth's part of a list that may be shorter, or empty.
template <class List>
List part_of(const std::vector<List>& all, std::size_t cloth) {
  return cloth < all.size() ? all[cloth] : List();
}

void add_targets(const std::vector<Vec3d>& targets, ByteWriter& out) {
  out.add(static_cast<std::uint64_t>(targets.size()));
  for (const Vec3d& target : targets) out.add(target.x), out.add(target.y), out.add(target.z);
}

/// Reads where pins hold a cloth; nothing for a count that the bytes do not hold.
std::optional<std::vector<Vec3d>> next_targets(ByteReader& in) {
  const auto count = in.next<std::uint64_t>();
  if (count > in.left() / sizeof(Vec3d)) return std::nullopt;
  std::vector<Vec3d> targets(static_cast<std::size_t>(count));
  for (Vec3d& target : targets) in.read(target.x), in.read(target.y), in.read(target.z);
  return targets;
}

/// Visits what a state has of all cloths together.
template <class State, class Visit>
void each_field_of_stepping(State& state, const Visit& visit) {
  visit(state.frame), visit(state.levels.first), visit(state.levels.most);
  auto& work = state.work;
  visit(work.net), visit(work.gross), visit(work.pulled), visit(work.least);
  visit(state.frames_unexplained);
}

bool is_valid_stepping(const SimulationState& state) {
  return state.frame >= 0 && is_valid(state.levels) && state.frames_unexplained >= 0 &&
         state.frames_unexplained <= state.frame;
}

/// Reads what `read` gives for each of the cloths; false where it gives nothing.
template <class List, class Read>
bool read_each(std::size_t cloths, std::vector<List>& lists, const Read& read) {
  for (std::size_t i = 0; i < cloths; ++i) {
    std::optional<List> list = read(i);
    if (!list) return false;
    lists.push_back(std::move(*list));
  }
  return true;
}

bool read_cloths(ByteReader& in, SimulationState& state) {
  const auto count = in.next<std::uint32_t>();
  return read_each(count, state.cloths, [&](std::size_t) { return next_cloth(in); });
}

/// Reads what belongs to each of the cloths that were read.
bool read_parts_of_cloths(ByteReader& in, SimulationState& state) {
  const std::size_t cloths = state.cloths.size();
  int most = 0;
  for (const ClothState& cloth : state.cloths) most = std::max(most, samples_of(cloth));
  const auto marks = [&](std::size_t i) {
    const auto samples = static_cast<std::size_t>(samples_of(state.cloths[i]));
    return next_marks(samples + cloths - i, in);
  };
  const auto contacts = [&](std::size_t i) {
    return next_contacts(samples_of(state.cloths[i]), most, in);
  };
  const auto targets = [&](std::size_t) { return next_targets(in); };
  for (std::size_t i = 0; i < cloths; ++i) state.fitted.push_back(in.next<std::uint8_t>() != 0);
  return read_each(cloths, state.marks, marks) && read_each(cloths, state.contacts, contacts) &&
         read_each(cloths, state.pin_targets, targets);
}

}  // namespace

void add_state(const SimulationState& state, ByteWriter& out) {
  each_field_of_stepping(state, [&](auto value) { out.add(value); });
  const std::size_t cloths = state.cloths.size();
  out.add(static_cast<std::uint32_t>(cloths));
  for (const ClothState& cloth : state.cloths) add_cloth(cloth, out);
  for (std::size_t i = 0; i < cloths; ++i)
    out.add(static_cast<std::uint8_t>(i < state.fitted.size() ? state.fitted[i] : 0));
  for (std::size_t i = 0; i < cloths; ++i) add_marks(part_of(state.marks, i), out);
  for (std::size_t i = 0; i < cloths; ++i) add_contacts(part_of(state.contacts, i), out);
  for (std::size_t i = 0; i < cloths; ++i) add_targets(part_of(state.pin_targets, i), out);
  add_struck(state.struck, out);
}

std::optional<SimulationState> next_state(ByteReader& in) {
  SimulationState state;
  each_field_of_stepping(state, [&](auto& value) { in.read(value); });
  if (!is_valid_stepping(state) || !read_cloths(in, state) || !read_parts_of_cloths(in, state))
    return std::nullopt;
  std::optional<std::vector<StruckContact>> struck = next_struck(in);
  if (!struck || !in.whole()) return std::nullopt;
  state.struck = std::move(*struck);
  return state;
}

}  // namespace weft
