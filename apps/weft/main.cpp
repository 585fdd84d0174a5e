#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <system_error>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/weft/commands.h"
#include "apps/weft/terminal_progress.h"
#include "weft/error.h"

namespace weft::app {
namespace {

int fail(ExitCode code, std::string_view what) {
  tell("error", what);
  return static_cast<int>(code);
}

std::string check_instructions(const std::string& name) {
  const auto set = find_instruction_set(name);
  if (!set) return "'" + name + "' is none of baseline, avx2, avx512";
  return has_instruction_set(*set) ? "" : "this processor has no " + name;
}

std::string check_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto [read_to, error] = std::from_chars(text.data(), end, seed);
  if (error == std::errc{} && read_to == end) return "";
  return "'" + text + "'; a whole number from 0 to " +
         std::to_string(std::numeric_limits<std::uint64_t>::max()) + " is wanted";
}

void add_globals(CLI::App& program, Context& context) {
  program.add_flag("--json", context.json,
                   "Print one JSON object on stdout and nothing else there");
  program.add_flag("--quiet", context.quiet, "Print nothing but errors (and the JSON object)");
  program.add_option("--threads", context.threads, "Threads; results do not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  program
      .add_option_function<std::string>(
          "--instructions",
          [&context](const std::string& name) {
            context.instructions = *find_instruction_set(name);
          },
          "Widest vectors to step cloth with: baseline, avx2 or avx512; results do not depend on "
          "it")
      ->check(check_instructions);
  program
      .add_option("--seed", context.seed,
                  "Of anything random: the samples that distances are measured by")
      ->check(check_seed)
      ->capture_default_str();
  program.set_version_flag("--version", "weft " WEFT_VERSION);
  program.fallthrough();
}

// CLI11 words its errors over several lines; users get one.
std::string one_line(const CLI::App& program, std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  const std::vector<CLI::App*> command = program.get_subcommands();
  return text + "; see weft " + (command.empty() ? "" : command[0]->get_name() + " ") + "--help";
}

std::string command_names(const CLI::App& program) {
  std::string names;
  for (const CLI::App* command : program.get_subcommands({}))
    names.append(names.empty() ? "" : ", ").append(command->get_name());
  return names;
}

// Error message for a wrong command line. Without a command it names the word in its place.
std::string complaint(const CLI::App& program, const CLI::ParseError& error) {
  if (!program.get_subcommands().empty()) return one_line(program, error.what());
  for (const std::string& arg : program.remaining())
    if (!arg.starts_with('-'))
      return fmt::format("'{}' is no command; one of {} is wanted", arg, command_names(program));
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    return fmt::format("no command; one of {} is wanted", command_names(program));
  return one_line(program, error.what());
}

// Checks that everything printed was written.
int finish() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return static_cast<int>(ExitCode::done);
  return fail(ExitCode::input,
              "stdout: cannot be written whole; a standard output with room is wanted");
}

int run(int argc, char** argv) {
  Context context;
  context.threads =
      static_cast<int>(std::max(1U, std::min(8U, std::thread::hardware_concurrency())));
  CLI::App program{"Turns meshes into geometry images and simulates those as cloth.", "weft"};
  add_globals(program, context);
  add_convert(program, context);
  add_rebuild(program, context);
  add_inspect(program, context);
  add_simulate(program, context);
  add_drape(program, context);
  add_garment(program, context);
  add_render(program, context);
  add_view(program, context);
  add_shapes(program, context);
  add_fabric(program, context);
  add_table5(program, context);
  add_demo(program, context);
  program.require_subcommand(1);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return program.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    return fail(ExitCode::usage, complaint(program, error));
  }
  return finish();
}

}  // namespace
}  // namespace weft::app

int main(int argc, char** argv) {
  using weft::ExitCode;
  try {
    weft::app::stop_on_signals();
    // A limit on the size of files is an error of writing.
    (void)std::signal(SIGXFSZ, SIG_IGN);
    return weft::app::run(argc, argv);
  } catch (const weft::Error& error) {
    return weft::app::fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return weft::app::fail(ExitCode::internal, "out of memory");
  } catch (const std::exception& error) {
    return weft::app::fail(ExitCode::internal, error.what());
  }
}
