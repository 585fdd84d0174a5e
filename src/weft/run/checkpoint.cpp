#include "weft/run/checkpoint.h"

#include <ostream>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/run/bytes.h"
#include "weft/run/sealed_bytes.h"
#include "weft/run/state_fields.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr Seal seal_of_checkpoints{"WEFTCKPT", 14, "checkpoint",
                                   "a run without --resume starts afresh"};

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

template <class Counts, class Visit>
void each_count(Counts& counts, const Visit& visit) {
  for (auto* count : {&counts.self, &counts.cloths, &counts.bodies, &counts.ground}) visit(*count);
}

template <class Counts, class Visit>
void each_worst(Counts& counts, const Visit& visit) {
  for (auto* worst : {&counts.passed, &counts.swallowed, &counts.written})
    visit(worst->frame), visit(worst->count);
}

void add_payload(const Checkpoint& checkpoint, ByteWriter& out) {
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
  add_state(checkpoint.state, out);
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
  std::optional<SimulationState> state = next_state(in);
  if (!state || in.left() != 0 || static_cast<std::uint64_t>(state->frame) != frames)
    return std::nullopt;
  checkpoint.state = std::move(*state);
  return checkpoint;
}

}  // namespace

fs::path checkpoint_path(const fs::path& folder) { return folder / "weft-checkpoint.bin"; }

std::string encode_checkpoint(const Checkpoint& checkpoint) {
  ByteWriter out;
  add_payload(checkpoint, out);
  return seal(seal_of_checkpoints, out.take());
}

Checkpoint decode_checkpoint(std::string_view bytes, const std::string& where) {
  ByteReader in(unseal(seal_of_checkpoints, bytes, where));
  std::optional<Checkpoint> checkpoint = parse_payload(in);
  if (!checkpoint) refuse(seal_of_checkpoints, where, "is damaged: its parts do not fit together");
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
