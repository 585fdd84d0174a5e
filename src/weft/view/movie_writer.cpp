#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "weft/error.h"
#include "weft/files.h"
#include "weft/picture.h"

namespace weft {
namespace {

/// Owns a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { reset(); }
  [[nodiscard]] int value() const { return value_; }
  void reset() {
    if (value_ >= 0) ::close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

/// Collects the messages of a process in an anonymous temporary file, which, unlike a pipe, takes
/// any amount without a reader.
class Transcript {
 public:
  Transcript() : file_(std::tmpfile()) {}
  Transcript(const Transcript&) = delete;
  Transcript& operator=(const Transcript&) = delete;
  ~Transcript() {
    if (file_ != nullptr) static_cast<void>(std::fclose(file_));
  }
  [[nodiscard]] int descriptor() const { return file_ == nullptr ? -1 : ::fileno(file_); }
  [[nodiscard]] std::string last_line() const {
    if (file_ == nullptr) return {};
    std::rewind(file_);
    std::string line;
    std::array<char, 512> part{};
    while (std::fgets(part.data(), part.size(), file_) != nullptr) line = part.data();
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.pop_back();
    return line;
  }

 private:
  std::FILE* file_;
};

/// ffmpeg options of a movie format, by file extension. The number of threads is left to ffmpeg: it
/// has no visible effect.
std::vector<std::string> format_options(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  if (ending == ".mp4")
    return {"-c:v",     "libx264", "-crf",      "18",         "-preset", "medium",
            "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f",      "mp4"};
  if (ending == ".gif")
    return {"-filter_complex",
            "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer", "-f",
            "gif"};
  throw OutputError(path.string(), fmt::format("the ending is '{}'", path.extension().string()),
                    ".mp4 or .gif is wanted");
}

std::vector<std::string> command(const std::filesystem::path& path, const std::string& output,
                                 const std::string& size, double frame_rate) {
  std::vector<std::string> words{"ffmpeg",   "-y",       "-loglevel", "error",
                                 "-nostats",
                                 "-xerror",  // otherwise a full disk is not reported
                                 "-f",       "rawvideo", "-pix_fmt",  "rgb24",
                                 "-s",       size,       "-r",        fmt::format("{}", frame_rate),
                                 "-i",       "pipe:0"};
  for (std::string& word : format_options(path)) words.push_back(std::move(word));
  words.push_back("file:" + output);
  return words;
}

/// Starts a program found on the PATH, in a process group of its own: a keyboard interrupt then
/// reaches only the caller, who can finish the movie properly.
/// @return its process id, or -1 with errno set
pid_t start(const std::vector<std::string>& words, int in, int error) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  if (error >= 0) posix_spawn_file_actions_adddup2(&actions, error, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = -1;
  errno = ::posix_spawnp(&child, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return errno == 0 ? child : -1;
}

std::array<int, 2> connected_pair(const std::filesystem::path& path) {
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw OutputError(path.string(), fmt::format("no pipe to ffmpeg: {}", std::strerror(errno)),
                      "a system with files to spare is wanted");
  return ends;
}

}  // namespace

/// The connection to ffmpeg. Frames go through a socket, not a plain pipe: writing after ffmpeg has
/// exited is then an error that can be reported, without a signal that would end the program.
struct MovieWriter::Pipe {
  std::filesystem::path path;
  int width, height;
  NewFile file;
  Transcript transcript;
  std::array<int, 2> ends;
  Descriptor frames, reader;
  pid_t child = -1;
  int count = 0;  // frames sent

  Pipe(const std::filesystem::path& movie, int picture_width, int picture_height)
      : path(movie),
        width(picture_width),
        height(picture_height),
        file(movie),
        ends(connected_pair(movie)),
        frames(ends[0]),
        reader(ends[1]) {}
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    if (child < 0) return;
    ::kill(child, SIGKILL);
    wait();
  }
  /// Waits until ffmpeg exits. @return true when it succeeded
  bool wait() {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    child = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  /// ffmpeg's last message, with the movie's name in place of the temporary file's.
  [[nodiscard]] std::string reason() const {
    std::string said = transcript.last_line();
    const std::string hidden = file.temporary().string();
    const std::size_t at = said.find(hidden);
    if (at != said.npos) said.replace(at, hidden.size(), path.string());
    return said.empty() ? "without a word" : said;
  }
  [[noreturn]] void fail() {
    frames.reset();
    if (child >= 0) wait();
    throw OutputError(path.string(), "ffmpeg failed: " + reason(),
                      "room for it, and an ffmpeg that knows the format, are wanted");
  }
};

MovieWriter::MovieWriter(const std::filesystem::path& path, int width, int height,
                         double frame_rate) {
  format_options(path);
  if (ending_of(path) == ".mp4" && (width % 2 != 0 || height % 2 != 0))
    throw OutputError(path.string(), fmt::format("{} x {} pixels", width, height),
                      "even numbers, or a .gif, are wanted");
  if (width < 2 || height < 2 || !(frame_rate > 0))
    throw OutputError(path.string(),
                      fmt::format("{} x {} pixels at {}/s", width, height, frame_rate),
                      "2 x 2 pixels or more and a positive rate are wanted");
  pipe_ = std::make_unique<Pipe>(path, width, height);
  pipe_->child = start(command(path, pipe_->file.temporary().string(),
                               fmt::format("{}x{}", width, height), frame_rate),
                       pipe_->reader.value(), pipe_->transcript.descriptor());
  const int reason = errno;
  pipe_->reader.reset();
  if (pipe_->child < 0)
    throw OutputError(path.string(),
                      fmt::format("ffmpeg cannot be started: {}", std::strerror(reason)),
                      "ffmpeg on the PATH is wanted");
}

MovieWriter::~MovieWriter() = default;

void MovieWriter::add(const Picture& picture) {
  if (picture.width != pipe_->width || picture.height != pipe_->height)
    throw OutputError(pipe_->path.string(),
                      fmt::format("a frame of {} x {} pixels", picture.width, picture.height),
                      fmt::format("{} x {} are wanted", pipe_->width, pipe_->height));
  std::size_t sent = 0;
  while (sent < picture.rgb.size()) {
    const ssize_t count = ::send(pipe_->frames.value(), picture.rgb.data() + sent,
                                 picture.rgb.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) pipe_->fail();
    sent += static_cast<std::size_t>(count);
  }
  ++pipe_->count;
}

void MovieWriter::finish() {
  if (pipe_->count == 0)
    throw OutputError(pipe_->path.string(), "a movie without a frame", "one or more are wanted");
  pipe_->frames.reset();
  if (pipe_->child < 0 || !pipe_->wait()) pipe_->fail();
  pipe_->file.commit();
}

}  // namespace weft
