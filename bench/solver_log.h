#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "bench/solver_tables.h"

namespace weft::bench {

/// The outcomes of finished trials, in a file: a bench of hours that was ended goes on with the
/// trials that it lacks. A line has the trial, the method and the outcome, all numbers exactly.
class SolverLog {
 public:
  /// @param file  read if it is there; empty: nothing is kept
  /// @param method  what else the outcomes depend on
  /// @throws std::runtime_error if a line of it is not one of these
  SolverLog(std::filesystem::path file, std::string method);

  /// @return whether the trial is there, whose outcome it then sets
  bool find(const Trial& trial, Outcome& outcome) const;
  /// Adds a line; may be called by several threads. @throws std::runtime_error if it cannot
  void add(const Trial& trial, const Outcome& outcome);

 private:
  [[nodiscard]] std::string key_of(const Trial& trial) const;

  std::filesystem::path file_;
  std::string method_;
  std::map<std::string, Outcome> outcomes_;
  std::mutex mutex_;
};

}  // namespace weft::bench
