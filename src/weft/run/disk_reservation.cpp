#include "weft/run/disk_reservation.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "weft/error.h"

namespace weft {

DiskReservation::DiskReservation(const std::filesystem::path& path, std::uintmax_t bytes)
    : file_(path, TemporaryName::of_the_file) {
  const int handle = ::open(file_.temporary().c_str(), O_WRONLY | O_CLOEXEC);
  const int reason = handle < 0 ? errno : ::posix_fallocate(handle, 0, static_cast<off_t>(bytes));
  if (handle >= 0) ::close(handle);
  if (reason == 0) return;
  throw OutputError(path.parent_path().string(),
                    std::string("no room to report in: ") + std::strerror(reason),
                    "more room is wanted");
}

}  // namespace weft
