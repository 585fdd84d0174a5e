#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <string>

#include "bench/solver_tables.h"

namespace weft::bench {

/// The outcomes of finished trials, in a file: a bench of hours that was ended goes on with the
/// trials that it lacks. A line has the program, the method, the trial and the outcome, all numbers
/// exactly. Outcomes of other programs and methods stay in the file and are not found.
class SolverLog {
 public:
  /// @param file  read if it is there, and created if not; empty: nothing is kept
  /// @param method  what outcomes depend on besides the trial and this program
  /// @throws std::runtime_error if a line is not one of these, but for a last one that was cut
  /// short, or if it cannot be written
  SolverLog(const std::filesystem::path& file, const std::string& method);

  /// @return whether the trial is there, whose outcome it then sets
  bool find(const Trial& trial, Outcome& outcome) const;
  /// Adds a line, or says on stderr that it cannot; may be called by several threads.
  void add(const Trial& trial, const Outcome& outcome);

 private:
  [[nodiscard]] std::string key_of(const Trial& trial) const;

  std::string method_;  // with the program
  std::ofstream out_;
  std::map<std::string, Outcome> outcomes_;
  std::mutex mutex_;
};

}  // namespace weft::bench
