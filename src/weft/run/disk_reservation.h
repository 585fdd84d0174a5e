#pragma once

#include <cstdint>
#include <filesystem>

#include "weft/files.h"

namespace weft {

/// Room on a disk that is held until it is needed: where other files may fill the disk, what tells
/// of them still finds a place. Held by a file with a temporary name.
class DiskReservation {
 public:
  /// @param path  beside which the room is; nothing appears under this name
  /// @throws OutputError when there is not as much
  DiskReservation(const std::filesystem::path& path, std::uintmax_t bytes);

 private:
  NewFile file_;
};

}  // namespace weft
