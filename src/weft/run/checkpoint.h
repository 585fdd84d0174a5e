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

/// State of a run, from which another process can continue it to the same bits and reports.
struct Checkpoint {
  std::string identity;                ///< of the run, see run_identity
  Vec3d start_centre;                  ///< centre of mass at frame 0 [m]
  FrameIntersections intersections;    ///< of the worst frame so far, where all are checked
  std::optional<int> untangled_frame;  ///< see RunReport
  Verification verification;           ///< see RunReport
  std::vector<FrameReport> history;    ///< one a frame, from frame 1
  SimulationState state;
};

/// Path of the checkpoint of a run.
std::filesystem::path checkpoint_path(const std::filesystem::path& folder);

/// Writes a checkpoint whole. @throws OutputError
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);
/// Reads a checkpoint; nothing when there is no such file.
/// @throws InputError for a file that is damaged, cut short, of another version or no checkpoint
std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& path);

/// Encodes the file in memory: "WEFTCKPT", sealed, then the fields in order.
std::string encode_checkpoint(const Checkpoint& checkpoint);
/// @param where  for errors
Checkpoint decode_checkpoint(std::string_view bytes, const std::string& where);

}  // namespace weft
