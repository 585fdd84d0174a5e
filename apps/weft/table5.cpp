#include "weft/table5.h"

#include <array>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/weft/commands.h"
#include "apps/weft/terminal_progress.h"

namespace weft::app {
namespace {

using Json = nlohmann::ordered_json;

/// Sizes whose image halves down to the coarsest level, as the paper's do not.
constexpr std::array<int, 4> multigrid_sizes{17, 33, 65, 129};

struct Table5Args {
  bool full = false;
  int frames = Table5Options{}.frames;
  CLI::Option* threads = nullptr;
};

struct SizeTime {
  int n = 0;
  double seconds = 0;
};

Json optional_json(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json row_json(const Table5Row& row) {
  return {{"n", row.paper.n},
          {"particles", row.particles},
          {"ng", row.paper.global_size},
          {"nl", row.paper.local_size},
          {"precompute_wg_s", row.global_matrix},
          {"precompute_wl_s", row.local_matrix},
          {"integration_s", row.two_level},
          {"desbrun_precompute_s", row.dense_matrix},
          {"desbrun_integration_s", row.desbrun},
          {"multigrid_integration_s", row.multigrid},
          {"paper_integration_s", row.paper.integration},
          {"paper_desbrun_integration_s", row.paper.dense_integration},
          {"rms_error_two_level", optional_json(row.two_level_error)},
          {"rms_error_desbrun", optional_json(row.desbrun_error)},
          {"rms_error_multigrid", optional_json(row.multigrid_error)},
          {"stiffness", row.stiffness}};
}

Json table_json(const std::vector<Table5Row>& rows, const std::vector<SizeTime>& sizes,
                const TeamOptions& team) {
  Json json{{"rows", Json::array()},
            {"multigrid_sizes", Json::array()},
            {"threads", team.size},
            {"instructions", name_of(team.instructions)}};
  for (const Table5Row& row : rows) json["rows"].push_back(row_json(row));
  for (const SizeTime& size : sizes)
    json["multigrid_sizes"].push_back({{"n", size.n}, {"multigrid_integration_s", size.seconds}});
  return json;
}

std::string seconds_text(const std::optional<double>& seconds) {
  return seconds ? fmt::format("{:.5g}", *seconds) : "-";
}

/// Beginning of a row: the cloth, in its first row only, n_g and n_l.
std::string row_head(const Table5Row& row, bool first) {
  const std::string cloth = first ? fmt::format("{0} x {0}", row.paper.n) : "";
  return fmt::format("{:<8} {:>3} {:>3}", cloth, row.paper.global_size, row.paper.local_size);
}

void say_steps(const Context& context, const Table5Row& row, bool first) {
  const Figure5Row& paper = row.paper;
  std::string line =
      row_head(row, first) + fmt::format(" {:>9.4f} {:>10} {:>6.0f}", 1e3 * row.two_level,
                                         paper.integration, paper.integration / row.two_level);
  line += first ? fmt::format(" {:>9.4f} {:>10}", 1e3 * row.desbrun, paper.dense_integration)
                : fmt::format(" {:>9} {:>10}", "", "");
  line += fmt::format(" {:>6.1f} {:>9.4f} {:>6.2f}", row.desbrun / row.two_level,
                      1e3 * row.multigrid, row.multigrid / row.two_level);
  if (row.two_level_error)
    line += fmt::format(" {:>9.2e} {:>9.2e} {:>9.2e}", *row.two_level_error, *row.desbrun_error,
                        *row.multigrid_error);
  say(context, line);
}

void say_matrices(const Context& context, const Table5Row& row, bool first) {
  const Figure5Row& paper = row.paper;
  say(context,
      row_head(row, first) +
          fmt::format(" {:>9.2e} {:>8} {:>9.2e} {:>8}", row.global_matrix,
                      seconds_text(paper.global_matrix), row.local_matrix, paper.local_matrix) +
          (first
               ? fmt::format(" {:>9.2e} {:>8}", row.dense_matrix, seconds_text(paper.dense_matrix))
               : ""));
}

/// Prints one line a row. @param say_row  as say_steps
void say_rows(const Context& context, const std::vector<Table5Row>& rows, const auto& say_row) {
  int size = 0;
  for (const Table5Row& row : rows) {
    say_row(context, row, row.paper.n != size);
    size = row.paper.n;
  }
}

void say_table(const Context& context, const std::vector<Table5Row>& rows,
               const std::vector<SizeTime>& sizes) {
  const bool errors = !rows.empty() && rows.front().two_level_error.has_value();
  say(context, "A whole step; in 2007 as printed; how many times faster; over two_level's time");
  say(context, fmt::format("{:16} {:^27} {:^27} {:^16}{}", "", "two_level", "desbrun", "multigrid",
                           errors ? fmt::format(" {:^29}", "RMS error [m]") : ""));
  say(context, fmt::format("{:<8} n_g n_l {:>9} {:>10} {:>6} {:>9} {:>10} {:>6} {:>9} {:>6}{}",
                           "cloth", "ms", "2007 [s]", "faster", "ms", "2007 [s]", "over", "ms",
                           "over", errors ? " two_level   desbrun multigrid" : ""));
  say_rows(context, rows, say_steps);
  for (const SizeTime& time : sizes)
    say(context,
        fmt::format("{:<62} {:>16.4f}", fmt::format("{0} x {0}", time.n), 1e3 * time.seconds));
  say(context, "\nMaking the matrices [s]");
  say(context, fmt::format("{:<8} n_g n_l {:>9} {:>8} {:>9} {:>8} {:>9} {:>8}", "cloth", "W_g",
                           "2007", "W_l", "2007", "W", "2007"));
  say_rows(context, rows, say_matrices);
}

void table5(const Table5Args& args, const Context& context) {
  Table5Options options;
  options.errors = args.full;
  options.frames = args.frames;
  // The paper's machine had one core.
  options.team = {args.threads->count() > 0 ? context.threads : 1, context.instructions};
  std::vector<Table5Row> rows;
  std::vector<SizeTime> sizes;
  {
    const PromptStop nothing_half_written;
    TerminalProgress progress(context.quiet || context.json);
    options.progress = &progress;
    rows = measure_table5(options);
    for (const int n : multigrid_sizes) sizes.push_back({n, measure_multigrid(n, options)});
  }
  say_table(context, rows, sizes);
  print_report(context, table_json(rows, sizes, options.team));
}

}  // namespace

void add_table5(CLI::App& program, const Context& context) {
  auto args = std::make_shared<Table5Args>();
  args->threads = program.get_option("--threads");
  CLI::App* command =
      program.add_subcommand("table5", "Measure the paper's Figure 5: its methods and multigrid");
  command->add_flag("--full", args->full, "Measure the error against a converged solution too");
  command->add_option("--frames", args->frames, "Frames that each method runs")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command->footer("On one thread unless --threads is given.\nExample: weft table5 --full --json");
  command->callback([args, &context] { table5(*args, context); });
}

}  // namespace weft::app
