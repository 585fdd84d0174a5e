#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <string_view>
#include <vector>

#include "weft/core/thread_team.h"
#include "weft/progress.h"

namespace weft {

/// Calls body(k, progress) for every k < count on a team of threads: thread r of n for r, r + n,
/// r + 2 n and so on. A thread ends at its first failure.
/// @param progress  of `stage`, may be null; told by the caller's thread alone, which may also be
///                  asked to stop there. Bodies of other threads get null.
/// @throws what the first call that failed threw, by k, whatever the number of threads
template <class Body>
void share_out(int count, int threads, Progress* progress, std::string_view stage,
               const Body& body) {
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(count));
  ThreadTeam team(std::clamp(threads, 1, std::max(1, count)));
  team.run([&](Worker& worker) {
    const bool is_caller = worker.rank() == 0;
    const double all = count;
    for (int k = worker.rank(); k < count; k += worker.size()) {
      PartOfProgress part(progress, stage, k / all,
                          std::min<double>(k + worker.size(), count) / all);
      try {
        body(k, is_caller ? &part : nullptr);
      } catch (...) {
        failures[static_cast<std::size_t>(k)] = std::current_exception();
        return;
      }
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace weft
