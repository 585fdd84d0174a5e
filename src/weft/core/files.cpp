#include "weft/files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "weft/core/names.h"
#include "weft/error.h"

namespace weft {
namespace fs = std::filesystem;
namespace {

constexpr const char* reservation_size = "more room, or another place, is wanted";

std::string system_reason() { return std::strerror(errno); }

/// Where a link leads: a file that is renamed into its place would end the link.
fs::path followed(fs::path path) {
  std::error_code error;
  constexpr int max_links = 40;  // as the system follows; those in a circle are written over
  for (int k = 0; k < max_links && fs::is_symlink(path, error); ++k)
    path = path.parent_path() / fs::read_symlink(path, error);
  return path;
}

}  // namespace

std::string ending_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

std::string read_file(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw InputError(path.string(), "is a folder", "a file is wanted");
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw InputError(path.string(), "cannot be opened: " + system_reason(),
                     "a readable file is wanted");
  // A buffer that fails throws, and iterators over it do not tell the stream.
  try {
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  } catch (const std::ios_base::failure&) {
    throw InputError(path.string(), "cannot be read: " + system_reason(),
                     "a readable file is wanted");
  }
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw OutputError(path.string(), "cannot be made: " + error.message(),
                      "a writable place is wanted");
}

void check_not_input(const fs::path& output, std::span<const fs::path> inputs) {
  std::error_code ignored;
  if (!fs::exists(output, ignored)) return;
  for (const fs::path& input : inputs) {
    if (fs::equivalent(output, input, ignored))
      throw OutputError(output.string(), "would be overwritten, and is read here",
                        "another place for what is written is wanted");
  }
}

WantedFolder::WantedFolder(const fs::path& path) {
  std::error_code ignored;
  for (fs::path missing = path; !missing.empty() && !fs::exists(missing, ignored);
       missing = missing.parent_path())
    made_.push_back(missing);
  make_folder(path);
}

WantedFolder::~WantedFolder() {
  std::error_code ignored;  // folders that are not empty stay
  for (const fs::path& path : made_) fs::remove(path, ignored);
}

void flush_to_disk(const fs::path& path) {
  const int handle = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = handle >= 0 && ::fsync(handle) == 0;
  const std::string reason = flushed ? "" : system_reason();
  if (handle >= 0) ::close(handle);
  if (!flushed) throw OutputError(path.string(), "cannot be written: " + reason, reservation_size);
}

fs::path temporary_path(const fs::path& path, TemporaryName name) {
  const bool own = name == TemporaryName::of_this_process;
  fs::path temporary = path;
  return temporary.replace_filename(fmt::format(".{}{}.part{}", path.stem().string(),
                                                own ? fmt::format(".{}", ::getpid()) : "",
                                                path.extension().string()));
}

NewFile::NewFile(fs::path path, TemporaryName name)
    : path_(followed(std::move(path))), temporary_(temporary_path(path_, name)) {
  std::error_code ignored;
  if (fs::is_directory(path_, ignored))
    throw OutputError(path_.string(), "is a folder", "a file name is wanted");
  const int emptied = name == TemporaryName::of_this_process ? O_TRUNC : 0;
  const int handle = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | emptied, 0666);
  if (handle < 0)
    throw OutputError(path_.string(), "cannot be written: " + system_reason(),
                      "a writable place is wanted");
  ::close(handle);
}

NewFile::~NewFile() {
  std::error_code ignored;
  if (!committed_ && !keep_) fs::remove(temporary_, ignored);
}

void NewFile::commit() {
  flush_to_disk(temporary_);
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error)
    throw OutputError(path_.string(), "cannot be written: " + error.message(),
                      "a writable place is wanted");
  committed_ = true;
}

FolderLock::FolderLock(const fs::path& folder)
    : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  // A file system without locks is no reason to fail.
  if (handle_ < 0 || ::flock(handle_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(handle_);
  throw OutputError(folder.string(), "another weft is writing there",
                    "another folder, or to wait until it is done, is wanted");
}

FolderLock::~FolderLock() {
  if (handle_ >= 0) ::close(handle_);
}

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write,
                TemporaryName name) {
  NewFile file(path, name);
  std::ofstream out(file.temporary(), std::ios::binary);
  write(out);
  out.close();
  if (!out)
    throw OutputError(path.string(), "cannot be written whole: " + system_reason(),
                      reservation_size);
  file.commit();
}

}  // namespace weft
