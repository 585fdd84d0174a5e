#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// The whole file as bytes.
/// @throws InputError when it is missing, a folder, or cannot be read
std::string read_file(const std::filesystem::path& path);

/// The ending of a name in lower case, with its dot; empty where it has none.
std::string ending_of(const std::filesystem::path& path);

/// Makes a folder and its missing parents; an existing one is left as it is.
/// @throws OutputError when it cannot be made, or a file has its name
void make_folder(const std::filesystem::path& path);

/// Refuses an output in the place of a file that the same work reads, by whatever name.
/// @param inputs  those that do not exist are passed over
/// @throws OutputError
void check_not_input(const std::filesystem::path& output,
                     std::span<const std::filesystem::path> inputs);

/// Makes a folder and its missing parents for output that may never be written: the destructor
/// removes those of them that are still empty.
class WantedFolder {
 public:
  /// @throws OutputError as make_folder
  explicit WantedFolder(const std::filesystem::path& path);
  WantedFolder(const WantedFolder&) = delete;
  WantedFolder& operator=(const WantedFolder&) = delete;
  ~WantedFolder();

 private:
  std::vector<std::filesystem::path> made_;  // innermost first
};

/// Waits until what was written to a file is on the disk. @throws OutputError
void flush_to_disk(const std::filesystem::path& path);

/// Temporary name of a file that is not complete: one per process, or a fixed one, under which the
/// next process finds what a killed one left.
enum class TemporaryName { of_this_process, of_the_file };
std::filesystem::path temporary_path(const std::filesystem::path& path, TemporaryName name);

/// A file that appears whole or not at all: written under a temporary name beside its place, then
/// renamed. Its place is where a link of that name leads. Unless `commit` was called, the
/// destructor removes what was written.
class NewFile {
 public:
  /// @throws OutputError when the folder is missing or cannot be written
  explicit NewFile(std::filesystem::path path, TemporaryName name = TemporaryName::of_this_process);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();
  /// Where to write until `commit`.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes to disk and puts the file in its place. @throws OutputError
  void commit();
  /// From now on the destructor leaves what was written.
  void keep_unfinished() { keep_ = true; }

 private:
  std::filesystem::path path_, temporary_;
  bool committed_ = false, keep_ = false;
};

/// Lock that reserves a folder for one process. The system releases it when the process ends, even
/// by a crash or kill.
class FolderLock {
 public:
  /// @throws OutputError when another process holds it
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int handle_ = -1;
};

/// Writes a file whole through a stream. @throws OutputError when it cannot be (full, no
/// permission)
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write,
                TemporaryName name = TemporaryName::of_this_process);

}  // namespace weft
