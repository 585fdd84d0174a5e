#include "bench/command_line.h"

#include <cstdio>
#include <exception>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace weft::bench {

struct CommandLine::App : CLI::App {
  using CLI::App::App;
};

CommandLine::CommandLine(const std::string& about) : app_(std::make_unique<App>(about)) {}

CommandLine::~CommandLine() = default;

void CommandLine::add(const std::string& name, Value value, const std::string& about) {
  const auto add_one = [&]<class T>(T* to) {
    if constexpr (std::is_same_v<T, bool>) {
      app_->add_flag(name, *to, about);
    } else {
      CLI::Option* const option = app_->add_option(name, *to, about);
      if constexpr (std::is_same_v<T, std::vector<int>>) option->delimiter(',');
      option->capture_default_str()->required(!name.starts_with('-'));
    }
  };
  std::visit(add_one, value);
}

int CommandLine::run(int argc, char** argv, const std::function<void()>& measure) {
  CLI11_PARSE(*app_, argc, argv);
  try {
    measure();
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench: error: {}\n", error.what());
    return 1;
  }
  return 0;
}

}  // namespace weft::bench
