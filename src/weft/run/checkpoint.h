#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weft/run.h"
#include "weft/run/verification.h"
#include "weft/simulation.h"

namespace weft {

/// Where a run stands, so that another process can go on with it to the same bits and reports.
struct Checkpoint {
  std::string identity;              ///< of the run, see run_identity
  Vec3d start_centre;                ///< centre of mass at frame 0 [m]
  FrameIntersections intersections;  ///< of the worst frame so far, where every frame is looked at
  std::optional<int> untangled_frame;  ///< see RunReport
  Verification verification;           ///< the same
  std::vector<FrameReport> history;    ///< one a frame, from frame 1
  SimulationState state;
};

/// Where a run keeps its checkpoint.
std::filesystem::path checkpoint_path(const std::filesystem::path& folder);

/// Writes it whole. @throws OutputError
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);
/// Nothing when there is no such file.
/// @throws InputError for a file that is damaged, cut short, of another version or no checkpoint
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path);

/// The file in memory: "WEFTCKPT", format version, bytes and hash of what follows, version of Weft,
/// then the fields in order; little-endian.
std::string encode_checkpoint(const Checkpoint& checkpoint);
/// @param where  for errors
Checkpoint decode_checkpoint(std::string_view bytes, const std::string& where);

}  // namespace weft
