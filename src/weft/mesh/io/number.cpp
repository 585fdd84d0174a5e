#include "weft/mesh/io/number.h"

#include <charconv>
#include <cmath>

namespace weft {
namespace {

// from_chars knows no leading plus, files do.
std::string_view without_plus(std::string_view field) {
  return field.size() > 1 && field[0] == '+' && field[1] != '-' ? field.substr(1) : field;
}

}  // namespace

std::optional<double> to_number(std::string_view field) {
  field = without_plus(field);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size() || error == std::errc::invalid_argument)
    return std::nullopt;
  if (error == std::errc::result_out_of_range)
    return field.find("e-") != field.npos || field.find("E-") != field.npos ? 0.0 : HUGE_VAL;
  return value;
}

std::optional<std::int64_t> to_integer(std::string_view field) {
  field = without_plus(field);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size() || error != std::errc()) return std::nullopt;
  return value;
}

std::string_view coordinate_fault(double value) {
  if (!std::isfinite(value)) return "is not finite";
  if (std::fabs(value) > 1e30) return "is larger than 1e30";
  return {};
}

}  // namespace weft
