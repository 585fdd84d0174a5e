#include "weft/sim/scene_file/json_object.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/json.h"
#include "weft/core/names.h"
#include "weft/error.h"

namespace weft {
namespace {

std::string shown(const nlohmann::json& value) {
  constexpr std::size_t longest = 40;
  std::string text = json_text(value);
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text;
}

std::string described(NumberRange range) {
  if (range.max < HUGE_VAL)
    return fmt::format("a number from {} to {} is wanted", range.min, range.max);
  if (range.min > -HUGE_VAL)
    return fmt::format("a number {} {} is wanted", range.min_excluded ? ">" : ">=", range.min);
  return "a finite number is wanted";
}

/// Whether a value is a list [warp, weft] of stiffnesses.
bool is_pair(const nlohmann::json& value) {
  const auto good = [](const nlohmann::json& one) {
    return one.is_number() && std::isfinite(one.get<double>()) && one.get<double>() >= 0;
  };
  return value.is_array() && value.size() == 2 && good(value[0]) && good(value[1]);
}

}  // namespace

JsonPlace JsonPlace::key(std::string_view name) const {
  return {file, path.empty() ? std::string(name) : fmt::format("{}.{}", path, name)};
}

JsonPlace JsonPlace::element(std::size_t index) const {
  return {file, fmt::format("{}[{}]", path, index)};
}

void JsonPlace::fail(std::string_view found, std::string_view wanted) const {
  throw SceneError(path.empty() ? file : fmt::format("{}:{}", file, path), found, wanted);
}

JsonObject::JsonObject(const nlohmann::json& value, JsonPlace place,
                       std::span<const std::string_view> keys)
    : value_(value), place_(std::move(place)) {
  if (!value.is_object())
    place_.fail(fmt::format("{} is no object", shown(value)), "an object {...} is wanted");
  for (const auto& [key, ignored] : value.items())
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      place_.key(key).fail("unknown key",
                           fmt::format("the nearest known key is '{}'",
                                       nearest_name(key, {keys.begin(), keys.end()})));
}

const nlohmann::json* JsonObject::find(std::string_view key) const {
  const auto at = value_.find(std::string(key));
  return at == value_.end() ? nullptr : &*at;
}

double JsonObject::number(std::string_view key, double fallback, NumberRange range) const {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return fallback;
  const bool is_number = value->is_number();
  const double x = is_number ? value->get<double>() : 0;
  const bool within =
      std::isfinite(x) && x <= range.max && (range.min_excluded ? x > range.min : x >= range.min);
  if (!is_number || !within) place_.key(key).fail(shown(*value), described(range));
  return x;
}

int JsonObject::integer(std::string_view key, int fallback, int min, int max) const {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return fallback;
  const bool whole = value->is_number_integer();
  if (!whole || value->get<double>() < min || value->get<double>() > max)
    place_.key(key).fail(shown(*value),
                         fmt::format("a whole number from {} to {} is wanted", min, max));
  return value->get<int>();
}

bool JsonObject::boolean(std::string_view key, bool fallback) const {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) place_.key(key).fail(shown(*value), "true or false is wanted");
  return value->get<bool>();
}

std::string JsonObject::text(std::string_view key, std::string_view fallback) const {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return std::string(fallback);
  if (!value->is_string()) place_.key(key).fail(shown(*value), "a string is wanted");
  return value->get<std::string>();
}

Vec3d JsonObject::vector(std::string_view key, Vec3d fallback) const {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return fallback;
  const std::vector<double> v = numbers_of(*value, place_.key(key), 3);
  return {v[0], v[1], v[2]};
}

WarpWeft JsonObject::warp_weft(std::string_view key, WarpWeft fallback) const {
  const nlohmann::json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_array()) return number(key, 0, not_negative);
  if (!is_pair(*value))
    place_.key(key).fail(shown(*value), "two numbers >= 0, [warp, weft], or one are wanted");
  return {(*value)[0].get<double>(), (*value)[1].get<double>()};
}

std::vector<double> numbers_of(const nlohmann::json& value, const JsonPlace& place,
                               std::size_t count) {
  std::vector<double> numbers;
  if (value.is_array())
    for (const nlohmann::json& element : value)
      if (element.is_number() && std::isfinite(element.get<double>()))
        numbers.push_back(element.get<double>());
  if (numbers.size() != count || value.size() != count)
    place.fail(shown(value), fmt::format("a list of {} finite numbers is wanted", count));
  return numbers;
}

}  // namespace weft
