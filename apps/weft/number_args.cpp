#include "apps/weft/number_args.h"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace weft::app {
namespace {

/// @param is_good  tells it of a number  @param wanted  what is, for the error
template <class IsGood>
CLI::Validator numbers(const IsGood& is_good, const std::string& wanted,
                       const std::string& description) {
  const auto judge = [=](const std::string& text) {
    const std::optional<double> number = finite_number(text);
    return number && is_good(*number) ? "" : fmt::format("'{}'; {} is wanted", text, wanted);
  };
  return {judge, description};
}

}  // namespace

std::optional<double> finite_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  double value = 0;
  const auto [read_to, error] = std::from_chars(text.data(), end, value);
  const bool good = error == std::errc{} && read_to == end && std::isfinite(value);
  return good ? std::optional(value) : std::nullopt;
}

CLI::Validator number_between(double low, double high) {
  return numbers([=](double value) { return value >= low && value <= high; },
                 fmt::format("a number from {:g} to {:g}", low, high),
                 fmt::format("FLOAT in [{:g} - {:g}]", low, high));
}

CLI::Validator number_above_zero() {
  return numbers([](double value) { return value > 0; }, "a number above 0", "");
}

CLI::Validator any_number() {
  return numbers([](double) { return true; }, "a finite number", "");
}

}  // namespace weft::app
