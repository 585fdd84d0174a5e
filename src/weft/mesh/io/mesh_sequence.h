#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "weft/point_cache.h"

namespace weft {

/// The name of numbered files: what stands before and behind the number, and its least digits.
struct SequenceName {
  std::string before, behind;
  int digits = 1;
};
/// @return nothing for a name without %d (or %04d and the like), or with two of them
std::optional<SequenceName> sequence_name(const std::filesystem::path& pattern);

/// Whether a name is that of numbered files in a format that keeps the order of vertices.
bool is_mesh_sequence_name(const std::filesystem::path& name);

/// The files of a sequence by ascending numbers.
struct MeshSequence {
  std::vector<std::filesystem::path> files;
  int step = 1;  ///< from one number to the next
};
/// @throws InputError where there are none, or a number is missing between them
MeshSequence find_mesh_sequence(const std::filesystem::path& pattern);

/// The vertices of each file of a sequence as the samples of a cache: times in frames, the step of
/// the numbers apart.
/// @throws InputError also for files of different numbers of vertices
PointCache read_mesh_sequence(const std::filesystem::path& pattern);

}  // namespace weft
