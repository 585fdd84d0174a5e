#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace weft::bench {

/// The command line of a benchmark. CLI11 is compiled once for all of them.
class CommandLine {
 public:
  /// What an option's value goes to; what is there already is the default.
  using Value = std::variant<int*, std::uint64_t*, double*, bool*, std::string*, std::vector<int>*,
                             std::vector<std::string>*>;

  explicit CommandLine(const std::string& about);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  ~CommandLine();

  /// Adds an option, or one that has to be there where the name begins without dashes. Numbers of a
  /// list stand with commas between them.
  void add(const std::string& name, Value value, const std::string& about = "");
  /// Reads the words and measures.
  /// @return the program's exit code: errors are printed
  int run(int argc, char** argv, const std::function<void()>& measure);

 private:
  struct App;
  std::unique_ptr<App> app_;
};

}  // namespace weft::bench
