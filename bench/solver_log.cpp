#include "bench/solver_log.h"

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "weft/core/hash.h"

namespace weft::bench {
namespace {

constexpr char between = ';';

std::string text_of(const Outcome& o) {
  return fmt::format("{} {} {} {} {} {} {} {} {}", o.centre, o.rms, o.gained, o.iterations,
                     o.milliseconds, o.strain, o.tight_strain, o.spread, o.unsolved);
}

/// What text_of() wrote; none where it did not. Streams read neither inf nor nan.
std::optional<Outcome> read_outcome(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> values;
  for (std::string word; in >> word;) {
    char* end = nullptr;
    values.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0') return std::nullopt;
  }
  if (values.size() != 9) return std::nullopt;
  return Outcome{values[0], values[1], values[2],
                 values[3], values[4], values[5],
                 values[6], values[7], static_cast<int>(values[8])};
}

/// A name of the program that runs.
std::string program_hash() {
  std::ifstream in("/proc/self/exe", std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  Hash hash;
  hash.add(std::span<const char>(bytes));
  return hash.text();
}

}  // namespace

SolverLog::SolverLog(const std::filesystem::path& file, const std::string& method)
    : method_(program_hash() + " " + method) {
  if (file.empty()) return;
  std::ifstream in(file);
  std::uintmax_t whole = 0;
  for (std::string line; std::getline(in, line) && !in.eof(); whole += line.size() + 1) {
    const std::size_t end = line.rfind(between);
    const auto outcome = end == line.npos ? std::nullopt : read_outcome(line.substr(end + 1));
    if (!outcome) throw std::runtime_error("not a trial and its outcome: " + line);
    outcomes_[line.substr(0, end)] = *outcome;
  }
  // Takes away a last line that was cut short.
  if (in.is_open() && whole > 0) std::filesystem::resize_file(file, whole);
  out_.open(file, std::ios::app);
  if (!out_) throw std::runtime_error("cannot write " + file.string());
}

std::string SolverLog::key_of(const Trial& trial) const {
  const Material& m = trial.material;
  return fmt::format(
      "{} n {} substeps {} frames {} of {} density {} stretch {} {} shear {} bending "
      "{} {} damping {} limit {}",
      method_, trial.size, trial.substeps, trial.compared_frames, trial.frames, m.density,
      m.stretch.warp, m.stretch.weft, m.shear, m.bending.warp, m.bending.weft, m.damping,
      m.strain_limit);
}

bool SolverLog::find(const Trial& trial, Outcome& outcome) const {
  const auto found = outcomes_.find(key_of(trial));
  if (found == outcomes_.end()) return false;
  outcome = found->second;
  return true;
}

void SolverLog::add(const Trial& trial, const Outcome& outcome) {
  if (!out_.is_open()) return;
  const std::lock_guard lock(mutex_);
  out_ << key_of(trial) << between << text_of(outcome) << std::endl;
  if (!out_) std::fprintf(stderr, "bench: warning: an outcome was not kept\n");
}

}  // namespace weft::bench
