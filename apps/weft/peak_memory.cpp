#include "apps/weft/peak_memory.h"

#include <fstream>
#include <string>

namespace weft::app {

std::optional<double> peak_memory_mb() {
  constexpr double mb_of_kib = 1024e-6;
  std::ifstream status("/proc/self/status");
  std::string arg;
  while (status >> arg) {
    double kib = 0;
    if (arg == "VmHWM:" && status >> kib) return kib * mb_of_kib;
  }
  return std::nullopt;
}

}  // namespace weft::app
