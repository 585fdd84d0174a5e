#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

namespace weft {

/// The whole file as bytes.
/// @throws InputError when it is missing, a folder, or cannot be read
std::string read_file(const std::filesystem::path& path);

/// Makes a folder and those that it lies in; one that is there is left as it is.
/// @throws OutputError when it cannot be made, or a file has its name
void make_folder(const std::filesystem::path& path);

/// A file that appears whole or not at all: written under a temporary name beside its place, then
/// renamed. Unless `commit` was called, the destructor removes what was written.
class NewFile {
 public:
  /// @throws OutputError when the folder is missing or cannot be written
  explicit NewFile(std::filesystem::path path);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();
  /// Where to write until `commit`.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes to disk and puts the file in its place. @throws OutputError
  void commit();

 private:
  std::filesystem::path path_, temporary_;
  bool committed_ = false;
};

/// Writes a file whole through a stream. @throws OutputError when it cannot be (full, no
/// permission)
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace weft
