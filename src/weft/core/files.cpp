#include "weft/core/files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "weft/core/error.h"

namespace weft {
namespace fs = std::filesystem;
namespace {

std::string system_reason() { return std::strerror(errno); }

}  // namespace

std::string read_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw InputError(path.string(), "is a folder", "a file is wanted");
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw InputError(path.string(), "cannot be opened: " + system_reason(),
                     "a readable file is wanted");
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (in.bad())
    throw InputError(path.string(), "cannot be read: " + system_reason(),
                     "a readable file is wanted");
  return bytes;
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw OutputError(path.string(), "cannot be made: " + error.message(),
                      "a writable place is wanted");
}

NewFile::NewFile(fs::path path) : path_(std::move(path)), temporary_(path_) {
  std::error_code ignored;
  if (fs::is_directory(path_, ignored))
    throw OutputError(path_.string(), "is a folder", "a file name is wanted");
  temporary_.replace_filename(
      fmt::format(".{}.{}.part{}", path_.stem().string(), ::getpid(), path_.extension().string()));
  const int handle = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (handle < 0)
    throw OutputError(path_.string(), "cannot be written: " + system_reason(),
                      "a writable place is wanted");
  ::close(handle);
}

NewFile::~NewFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
}

void NewFile::commit() {
  const int handle = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = handle >= 0 && ::fsync(handle) == 0;
  const std::string reason = flushed ? "" : system_reason();
  if (handle >= 0) ::close(handle);
  if (!flushed) throw OutputError(path_.string(), "cannot be written: " + reason, "");
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) throw OutputError(path_.string(), "cannot be written: " + error.message(), "");
  committed_ = true;
}

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  NewFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  write(out);
  out.close();
  if (!out) throw OutputError(path.string(), "cannot be written whole: " + system_reason(), "");
  file.commit();
}

}  // namespace weft
