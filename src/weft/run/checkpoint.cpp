#include "weft/run/checkpoint.h"

#include <cstring>
#include <ostream>
#include <span>

#include <fmt/format.h>

#include "weft/core/hash.h"
#include "weft/error.h"
#include "weft/files.h"
#include "weft/geometry_image.h"
#include "weft/run/bytes.h"
#include "weft/sim/stepping/adaptive_substeps.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "WEFTCKPT";
constexpr std::uint32_t format_version = 12;
constexpr std::size_t size_at = magic.size() + sizeof(format_version);
constexpr std::size_t hash_at = size_at + sizeof(std::uint64_t);
constexpr std::size_t payload_at = hash_at + sizeof(std::uint64_t);
constexpr std::string_view weft_version = WEFT_VERSION;

/// Visits every field of a frame report in the order of the file; a field missing here would be
/// lost in the tables of a resumed run.
template <class Report, class Visit>
void each_field(Report& f, const Visit& visit) {
  visit(f.milliseconds), visit(f.forces_ms), visit(f.solve_ms), visit(f.collide_ms),
      visit(f.limit_ms);
  visit(f.iterations), visit(f.residual);
  visit(f.strain.mean), visit(f.strain.p99), visit(f.strain.max);
  visit(f.kinetic_energy), visit(f.potential_energy);
  visit(f.contacts), visit(f.self_contacts), visit(f.stopped), visit(f.fell_back);
  visit(f.whole_fell_back), visit(f.buried), visit(f.lost_time), visit(f.work),
      visit(f.smallest_gap), visit(f.seam_gap);
  visit(f.centre_of_mass.x), visit(f.centre_of_mass.y), visit(f.centre_of_mass.z);
}
static_assert(sizeof(FrameReport) == 22 * 8, "a new field goes into each_field, and this count up");
constexpr std::size_t frame_bytes = 17 * sizeof(double) + 7 * sizeof(int);

std::uint64_t hash_of(std::string_view bytes) {
  Hash hash;
  hash.add(std::span<const char>(bytes));
  return hash.value();
}

template <class State, class Visit>
void each_plane(State& state, const Visit& visit) {
  for (auto* planes : {&state.position, &state.velocity})
    for (auto* plane : {&planes->x, &planes->y, &planes->z}) visit(*plane);
}

template <class Counts, class Visit>
void each_count(Counts& counts, const Visit& visit) {
  for (auto* count : {&counts.self, &counts.cloths, &counts.bodies, &counts.ground}) visit(*count);
}

template <class Counts, class Visit>
void each_worst(Counts& counts, const Visit& visit) {
  for (auto* worst : {&counts.passed, &counts.swallowed, &counts.written})
    visit(worst->frame), visit(worst->count);
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

void add_payload(const Checkpoint& checkpoint, ByteWriter& out) {
  out.add_text(weft_version);
  out.add_text(checkpoint.identity);
  const Vec3d centre = checkpoint.start_centre;
  out.add(centre.x), out.add(centre.y), out.add(centre.z);
  out.add(static_cast<std::int32_t>(checkpoint.intersections.frame));
  each_count(checkpoint.intersections.counts, [&](std::int64_t count) { out.add(count); });
  out.add(static_cast<std::int32_t>(checkpoint.untangled_frame.value_or(-1)));
  each_worst(checkpoint.verification, [&](auto value) { out.add(value); });
  out.add(static_cast<std::uint64_t>(checkpoint.history.size()));
  for (const FrameReport& frame : checkpoint.history)
    each_field(frame, [&](auto value) { out.add(value); });
  const SimulationState& state = checkpoint.state;
  out.add(static_cast<std::int32_t>(state.levels.first));
  out.add(static_cast<std::int32_t>(state.levels.most));
  out.add(state.work.net), out.add(state.work.gross), out.add(state.work.pulled);
  out.add(state.work.least), out.add(static_cast<std::int32_t>(state.frames_unexplained));
  out.add(static_cast<std::uint32_t>(checkpoint.state.cloths.size()));
  for (const ClothState& cloth : checkpoint.state.cloths) add_cloth(cloth, out);
  for (std::size_t i = 0; i < checkpoint.state.cloths.size(); ++i)
    add_marks(i < checkpoint.state.marks.size() ? checkpoint.state.marks[i] : std::vector<int>(),
              out);
  for (std::size_t i = 0; i < checkpoint.state.cloths.size(); ++i)
    add_contacts(i < state.contacts.size() ? state.contacts[i] : std::vector<PastContact>(), out);
  add_struck(state.struck, out);
}

/// Reads a checkpoint; nothing when its fields are inconsistent, as in no file that Weft wrote.
std::optional<Checkpoint> parse_payload(ByteReader in) {
  Checkpoint checkpoint;
  checkpoint.identity = in.next_text();
  Vec3d& centre = checkpoint.start_centre;
  in.read(centre.x), in.read(centre.y), in.read(centre.z);
  in.read(checkpoint.intersections.frame);
  each_count(checkpoint.intersections.counts, [&](std::int64_t& count) { in.read(count); });
  if (const auto frame = in.next<std::int32_t>(); frame >= 0) checkpoint.untangled_frame = frame;
  each_worst(checkpoint.verification, [&](auto& value) { in.read(value); });
  const auto frames = in.next<std::uint64_t>();
  if (frames > in.left() / frame_bytes) return std::nullopt;
  checkpoint.history.resize(frames);
  for (FrameReport& frame : checkpoint.history)
    each_field(frame, [&](auto& value) { in.read(value); });
  checkpoint.state.frame = static_cast<int>(frames);
  StepLevels& levels = checkpoint.state.levels;
  in.read(levels.first), in.read(levels.most);
  if (!is_valid(levels)) return std::nullopt;
  WorkDone& work = checkpoint.state.work;
  in.read(work.net), in.read(work.gross), in.read(work.pulled), in.read(work.least);
  int& unexplained = checkpoint.state.frames_unexplained;
  in.read(unexplained);
  if (unexplained < 0 || unexplained > checkpoint.state.frame) return std::nullopt;
  const auto cloths = in.next<std::uint32_t>();
  for (std::uint32_t i = 0; i < cloths; ++i) {
    std::optional<ClothState> cloth = next_cloth(in);
    if (!cloth) return std::nullopt;
    checkpoint.state.cloths.push_back(std::move(*cloth));
  }
  for (std::size_t i = 0; i < checkpoint.state.cloths.size(); ++i) {
    const auto side = static_cast<std::size_t>(checkpoint.state.cloths[i].position.size());
    const std::size_t pairs = checkpoint.state.cloths.size() - i;
    std::optional<std::vector<int>> marks = next_marks(side * side + pairs, in);
    if (!marks) return std::nullopt;
    checkpoint.state.marks.push_back(std::move(*marks));
  }
  int most = 0;
  const auto samples_of = [](const ClothState& cloth) {
    return cloth.position.size() * cloth.position.size();
  };
  for (const ClothState& cloth : checkpoint.state.cloths) most = std::max(most, samples_of(cloth));
  for (const ClothState& cloth : checkpoint.state.cloths) {
    std::optional<std::vector<PastContact>> contacts = next_contacts(samples_of(cloth), most, in);
    if (!contacts) return std::nullopt;
    checkpoint.state.contacts.push_back(std::move(*contacts));
  }
  std::optional<std::vector<StruckContact>> struck = next_struck(in);
  if (!struck || !in.whole() || in.left() != 0) return std::nullopt;
  checkpoint.state.struck = std::move(*struck);
  return checkpoint;
}

[[noreturn]] void refuse(const std::string& where, std::string_view found) {
  throw InputError(where, found, "a run without --resume starts afresh");
}

}  // namespace

fs::path checkpoint_path(const fs::path& folder) { return folder / "weft-checkpoint.bin"; }

std::string encode_checkpoint(const Checkpoint& checkpoint) {
  ByteWriter out;
  out.add_bytes(magic);
  out.add(format_version);
  out.add(std::uint64_t{0}), out.add(std::uint64_t{0});
  add_payload(checkpoint, out);
  std::string bytes = out.take();
  const std::string_view payload = std::string_view(bytes).substr(payload_at);
  const std::uint64_t size = payload.size(), hash = hash_of(payload);
  std::memcpy(bytes.data() + size_at, &size, sizeof(size));
  std::memcpy(bytes.data() + hash_at, &hash, sizeof(hash));
  return bytes;
}

Checkpoint decode_checkpoint(std::string_view bytes, const std::string& where) {
  if (!bytes.starts_with(magic)) refuse(where, "is no checkpoint");
  ByteReader header(bytes.substr(magic.size()));
  const auto version = header.next<std::uint32_t>();
  if (header.whole() && version != format_version)
    refuse(where, fmt::format("has checkpoint format {} instead of {}", version, format_version));
  const auto size = header.next<std::uint64_t>();
  const auto hash = header.next<std::uint64_t>();
  if (!header.whole() || size != header.left())
    refuse(where, fmt::format("is damaged: {} bytes instead of {}", bytes.size(),
                              bytes.size() - header.left() + size));
  const std::string_view payload = bytes.substr(bytes.size() - size);
  if (hash != hash_of(payload)) refuse(where, "is damaged: its bytes do not give its hash");
  ByteReader in(payload);
  const std::string_view writer = in.next_text();
  if (writer != weft_version)
    refuse(where, fmt::format("was written by weft {}, this is {}", writer, weft_version));
  std::optional<Checkpoint> checkpoint = parse_payload(in);
  if (!checkpoint) refuse(where, "is damaged: its parts do not fit together");
  return std::move(*checkpoint);
}

void write_checkpoint(const fs::path& path, const Checkpoint& checkpoint) {
  const std::string bytes = encode_checkpoint(checkpoint);
  const auto write = [&](std::ostream& out) { out << bytes; };
  // The same temporary name for every process: a later one overwrites what a killed one left.
  write_file(path, write, TemporaryName::of_the_file);
}

std::optional<Checkpoint> read_checkpoint(const fs::path& path) {
  std::error_code ignored;
  if (fs::status(path, ignored).type() == fs::file_type::not_found) return std::nullopt;
  return decode_checkpoint(read_file(path), path.string());
}

}  // namespace weft
