#include "weft/mesh/io/gltf_object.h"

#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/json.h"
#include "weft/error.h"
#include "weft/mesh/io/line_reader.h"

namespace weft {
namespace {

using Json = nlohmann::json;

bool is_integer_in(const Json& value, std::int64_t least, std::int64_t most) {
  if (!value.is_number_integer()) return false;
  constexpr auto largest = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > largest) return false;
  const auto number = value.get<std::int64_t>();
  return number >= least && number <= most;
}

}  // namespace

GltfObject::GltfObject(const Json& value, std::string_view name, std::string place)
    : value_(&value), name_(name), place_(std::move(place)) {
  if (!value.is_object()) fail("is no JSON object", "an object {...} is wanted");
}

std::optional<std::int64_t> GltfObject::integer(std::string_view key, std::int64_t least,
                                                std::int64_t most) const {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!is_integer_in(*value, least, most))
    fail_at(key, fmt::format("a whole number from {} to {} is wanted", least, most));
  return value->get<std::int64_t>();
}

std::int64_t GltfObject::wanted(std::string_view key, std::int64_t least, std::int64_t most) const {
  const std::optional<std::int64_t> value = integer(key, least, most);
  if (!value) fail(fmt::format("has no {}", key), "one is wanted");
  return *value;
}

std::optional<int> GltfObject::index(std::string_view key, std::size_t count) const {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!is_integer_in(*value, 0, static_cast<std::int64_t>(count) - 1))
    fail_at(key, fmt::format("the number of one of {} is wanted", count));
  return value->get<int>();
}

bool GltfObject::boolean(std::string_view key) const {
  const Json* value = find(key);
  if (value != nullptr && !value->is_boolean()) fail_at(key, "true or false is wanted");
  return value != nullptr && value->get<bool>();
}

std::optional<std::string> GltfObject::text(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_string()) fail_at(key, "a text is wanted");
  return value->get<std::string>();
}

std::optional<double> GltfObject::number(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (!value->is_number() || !std::isfinite(value->get<double>()))
    fail_at(key, "a finite number is wanted");
  return value->get<double>();
}

std::vector<double> GltfObject::numbers(std::string_view key, std::size_t count) const {
  std::vector<double> numbers;
  const Json* values = list(key);
  if (values == nullptr) return numbers;
  for (const Json& value : *values)
    if (value.is_number() && std::isfinite(value.get<double>()))
      numbers.push_back(value.get<double>());
  if (numbers.size() != count || values->size() != count)
    fail_at(key, fmt::format("a list of {} finite numbers is wanted", count));
  return numbers;
}

std::vector<int> GltfObject::indices(std::string_view key, std::size_t count) const {
  std::vector<int> indices;
  const Json* values = list(key);
  if (values == nullptr) return indices;
  for (const Json& value : *values) {
    if (!is_integer_in(value, 0, static_cast<std::int64_t>(count) - 1))
      fail_at(key, fmt::format("a list of numbers below {} is wanted", count));
    indices.push_back(value.get<int>());
  }
  return indices;
}

std::vector<std::string> GltfObject::texts(std::string_view key) const {
  std::vector<std::string> texts;
  const Json* values = list(key);
  if (values == nullptr) return texts;
  for (const Json& value : *values) {
    if (!value.is_string()) fail_at(key, "a list of texts is wanted");
    texts.push_back(value.get<std::string>());
  }
  return texts;
}

std::optional<GltfObject> GltfObject::object(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return GltfObject(*value, name_, place_of(key));
}

std::size_t GltfObject::count(std::string_view key) const {
  const Json* values = list(key);
  return values == nullptr ? 0 : values->size();
}

GltfObject GltfObject::element(std::string_view key, std::size_t index) const {
  return {(*list(key))[index], name_, fmt::format("{}[{}]", place_of(key), index)};
}

void GltfObject::fail(std::string_view found, std::string_view wanted) const {
  throw InputError(name_, place_.empty() ? std::string(found) : fmt::format("{} {}", place_, found),
                   wanted);
}

const Json* GltfObject::find(std::string_view key) const {
  const auto at = value_->find(std::string(key));
  return at == value_->end() ? nullptr : &*at;
}

const Json* GltfObject::list(std::string_view key) const {
  const Json* value = find(key);
  if (value != nullptr && !value->is_array()) fail_at(key, "a list is wanted");
  return value;
}

std::string GltfObject::place_of(std::string_view key) const {
  return place_.empty() ? std::string(key) : fmt::format("{}.{}", place_, key);
}

void GltfObject::fail_at(std::string_view key, std::string_view wanted) const {
  const Json& value = *find(key);
  const std::string shown =
      value.is_structured() ? std::string(value.type_name()) : json_text(value);
  throw InputError(name_, fmt::format("{} is {}", place_of(key), in_quotes(shown)), wanted);
}

}  // namespace weft
