#include "bench/solver_log.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace weft::bench {
namespace {

constexpr char between = ';';

std::string text_of(const Outcome& o) {
  return fmt::format("{} {} {} {} {} {} {} {} {}", o.centre, o.rms, o.gained, o.iterations,
                     o.milliseconds, o.strain, o.tight_strain, o.spread, o.unsolved);
}

Outcome read_outcome(const std::string& text) {
  Outcome o;
  std::istringstream in(text);
  in >> o.centre >> o.rms >> o.gained >> o.iterations >> o.milliseconds >> o.strain >>
      o.tight_strain >> o.spread >> o.unsolved;
  if (!in) throw std::runtime_error("not an outcome: " + text);
  return o;
}

}  // namespace

SolverLog::SolverLog(std::filesystem::path file, std::string method)
    : file_(std::move(file)), method_(std::move(method)) {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    const std::size_t end = line.rfind(between);
    if (end == std::string::npos) throw std::runtime_error("not a trial: " + line);
    outcomes_[line.substr(0, end)] = read_outcome(line.substr(end + 1));
  }
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
  if (file_.empty()) return;
  const std::lock_guard lock(mutex_);
  std::ofstream out(file_, std::ios::app);
  out << key_of(trial) << between << text_of(outcome) << std::endl;
  if (!out) throw std::runtime_error("cannot write " + file_.string());
}

}  // namespace weft::bench
