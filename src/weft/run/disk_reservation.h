#pragma once

#include <cstdint>
#include <filesystem>

#include "weft/files.h"

namespace weft {

/// Disk space reserved by a file with a temporary name while this exists, so that reports can still
/// be written when other files fill the disk.
class DiskReservation {
 public:
  /// @param path  beside which the temporary file lies; nothing appears under this name
  /// @throws OutputError when there is less space
  DiskReservation(const std::filesystem::path& path, std::uintmax_t bytes);

 private:
  NewFile file_;
};

}  // namespace weft
