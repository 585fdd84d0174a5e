#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/ccd/queries.h"
#include "weft/error.h"

namespace weft::ccd {
namespace {

struct Counts {
  int queries = 0, positives = 0, missed = 0, false_positives = 0;
  double seconds = 0;
  double largest_distance = 0;  ///< of what was reported [m]
  int steps_max = 0;
  int inexact = 0;  ///< queries with a coordinate that no double holds
};

void ask(const QueryFile& file, const CcdOptions& options, Counts& counts) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  for (const Query& query : file.queries) {
    const std::optional<Impact> impact = answer(query, file.kind, options);
    ++counts.queries;
    counts.positives += query.collides ? 1 : 0;
    counts.missed += query.collides && !impact ? 1 : 0;
    counts.false_positives += !query.collides && impact ? 1 : 0;
    counts.inexact += query.input_error > 0 ? 1 : 0;
    if (!impact) continue;
    counts.largest_distance = std::max(counts.largest_distance, impact->distance);
    counts.steps_max = std::max(counts.steps_max, impact->steps);
  }
  counts.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
}

int fail(ExitCode code, std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  fmt::print(stderr, "weft-ccd: error: {}\n", text);
  return static_cast<int>(code);
}

int run(int argc, char** argv) {
  CLI::App program{"Answers continuous-collision queries and counts what is missed.", "weft-ccd"};
  std::vector<std::string> paths;
  CcdOptions options;
  program.add_option("FILE", paths, "CSV files named *edge-edge* or *vertex-face*")->required();
  program
      .add_option("--tolerance", options.tolerance,
                  "Largest distance of a pair that is reported though it does not touch")
      ->capture_default_str();
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return program.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    return fail(ExitCode::usage, error.what());
  }
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    return fail(ExitCode::usage, "--tolerance: a finite number from 0 is wanted");
  Counts counts;
  for (const std::string& path : paths) ask(read_queries(path), options, counts);
  const nlohmann::ordered_json json{{"queries", counts.queries},
                                    {"positives", counts.positives},
                                    {"missed", counts.missed},
                                    {"false_positives", counts.false_positives},
                                    {"seconds", counts.seconds},
                                    {"tolerance", options.tolerance},
                                    {"largest_distance", counts.largest_distance},
                                    {"steps_max", counts.steps_max},
                                    {"inexact", counts.inexact}};
  fmt::print("{}\n", json.dump());
  return std::fflush(stdout) == 0 ? 0 : fail(ExitCode::input, "stdout: cannot be written whole");
}

}  // namespace
}  // namespace weft::ccd

int main(int argc, char** argv) {
  try {
    return weft::ccd::run(argc, argv);
  } catch (const weft::Error& error) {
    return weft::ccd::fail(error.code(), error.what());
  } catch (const std::exception& error) {
    return weft::ccd::fail(weft::ExitCode::internal, error.what());
  }
}
