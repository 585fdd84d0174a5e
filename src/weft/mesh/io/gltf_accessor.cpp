#include "weft/mesh/io/gltf_accessor.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "weft/mesh/io/byte_reader.h"
#include "weft/mesh/io/polygon.h"

namespace weft {
namespace {

enum class Component { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

/// Bytes of a component; 0 for an unknown type.
std::size_t size_of(Component component) {
  switch (component) {
    case Component::int8:
    case Component::uint8:
      return 1;
    case Component::int16:
    case Component::uint16:
      return 2;
    case Component::uint32:
    case Component::float32:
      return 4;
  }
  return 0;
}

/// The layout of an accessor's elements.
struct Elements {
  std::string_view bytes;
  std::size_t count = 0, stride = 0;
  Component component = Component::float32;
  bool normalized = false;

  [[nodiscard]] std::string_view at(std::size_t element, std::size_t k) const {
    return bytes.substr(element * stride + k * size_of(component));
  }
};

constexpr std::size_t max_zeros = 12'000'000;  ///< numbers of an accessor that are in no buffer

const char* type_of(std::size_t width) {
  switch (width) {
    case 1:
      return "SCALAR";
    case 2:
      return "VEC2";
    case 3:
      return "VEC3";
    case 4:
      return "VEC4";
    default:
      return "MAT4";
  }
}

/// Elements that an object places in a buffer view by its bufferView and byteOffset.
/// @param width  components of an element
/// @param count  how many there have to be
Elements lay_out(const GltfObject& root, GltfBuffers& buffers, const GltfObject& object,
                 Component component, std::size_t width, std::size_t count) {
  Elements elements;
  elements.component = component;
  elements.count = count;
  const std::size_t size = width * size_of(component);
  if (size == 0) object.fail("has an unknown componentType", "5120 .. 5123, 5125 or 5126");
  const std::optional<int> view = object.index("bufferView", root.count("bufferViews"));
  if (!view) object.fail("has no data", "a bufferView, uncompressed, is wanted");
  const GltfObject view_object = root.element("bufferViews", static_cast<std::size_t>(*view));
  elements.stride = static_cast<std::size_t>(
      view_object.integer("byteStride", static_cast<std::int64_t>(size), 252)
          .value_or(static_cast<std::int64_t>(size)));
  const std::string_view bytes = buffers.view(*view);
  const auto offset = object.integer("byteOffset", 0, static_cast<std::int64_t>(bytes.size()));
  elements.bytes = bytes.substr(static_cast<std::size_t>(offset.value_or(0)));
  const std::size_t room =
      elements.bytes.size() < size ? 0 : (elements.bytes.size() - size) / elements.stride + 1;
  if (count > room)
    object.fail(fmt::format("has {} elements where {} fit", count, room), "a whole file is wanted");
  return elements;
}

Component component_of(const GltfObject& object) {
  return static_cast<Component>(object.wanted("componentType", 5120, 5126));
}

std::size_t count_of(const GltfObject& object) {
  return static_cast<std::size_t>(object.wanted("count", 1, max_elements));
}

double number(const Elements& elements, std::string_view bytes) {
  const auto scaled = [&](double value, double most) {
    return elements.normalized ? std::max(value / most, -1.0) : value;
  };
  switch (elements.component) {
    case Component::int8:
      return scaled(static_cast<std::int8_t>(load_integer<std::uint8_t>(bytes, false)), 127);
    case Component::uint8:
      return scaled(load_integer<std::uint8_t>(bytes, false), 255);
    case Component::int16:
      return scaled(static_cast<std::int16_t>(load_integer<std::uint16_t>(bytes, false)), 32767);
    case Component::uint16:
      return scaled(load_integer<std::uint16_t>(bytes, false), 65535);
    case Component::uint32:
      return load_integer<std::uint32_t>(bytes, false);
    case Component::float32:
      return load_float(bytes, false);
  }
  return 0;
}

GltfObject accessor_of(const GltfObject& root, int index) {
  return root.element("accessors", static_cast<std::size_t>(index));
}

/// A number below `count` at a place of whole-number elements.
std::size_t index_at(const GltfObject& object, const Elements& elements, std::size_t place,
                     std::size_t count) {
  const double value = number(elements, elements.at(place, 0));
  if (!(value < static_cast<double>(count)))
    object.fail(fmt::format("names number {} of {}", value, count),
                "an existing one, counted from 0, is wanted");
  return static_cast<std::size_t>(value);
}

void check_index_type(const GltfObject& object, Component component) {
  if (component != Component::uint8 && component != Component::uint16 &&
      component != Component::uint32)
    object.fail("holds numbers of a wrong type", "5121, 5123 or 5125 is wanted");
}

/// How the numbers of an accessor are taken.
struct Layout {
  std::size_t width = 1;  ///< components of an element
  bool normalized = false;
};

/// Puts the elements in place that an accessor's `sparse` lists.
/// @param numbers  [elements * width]
void replace_sparse(const GltfObject& root, GltfBuffers& buffers, const GltfObject& accessor,
                    Layout layout, std::vector<double>& numbers) {
  const std::optional<GltfObject> sparse = accessor.object("sparse");
  if (!sparse) return;
  const std::size_t count = count_of(*sparse), all = numbers.size() / layout.width;
  const std::optional<GltfObject> indices = sparse->object("indices");
  const std::optional<GltfObject> values = sparse->object("values");
  if (!indices || !values) sparse->fail("has no indices or values", "both are wanted");
  const Component index_type = component_of(*indices);
  check_index_type(*indices, index_type);
  const Elements places = lay_out(root, buffers, *indices, index_type, 1, count);
  Elements given = lay_out(root, buffers, *values, component_of(accessor), layout.width, count);
  given.normalized = layout.normalized;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = index_at(*indices, places, i, all);
    for (std::size_t k = 0; k < layout.width; ++k)
      numbers[place * layout.width + k] = number(given, given.at(i, k));
  }
}

std::vector<double> read_all(const GltfObject& root, GltfBuffers& buffers,
                             const GltfObject& accessor, Layout layout) {
  const char* type = type_of(layout.width);
  if (accessor.text("type") != type)
    accessor.fail("has another type", fmt::format("{} is wanted", type));
  const std::size_t count = count_of(accessor);
  std::vector<double> numbers;
  if (!accessor.has("bufferView") && accessor.has("sparse")) {
    if (count > max_zeros / layout.width)
      accessor.fail(fmt::format("has {} elements in no buffer", count),
                    fmt::format("at most {} are wanted", max_zeros / layout.width));
    numbers.resize(count * layout.width);
  } else {
    Elements elements =
        lay_out(root, buffers, accessor, component_of(accessor), layout.width, count);
    elements.normalized = layout.normalized;
    numbers.reserve(count * layout.width);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < layout.width; ++k)
        numbers.push_back(number(elements, elements.at(i, k)));
  }
  replace_sparse(root, buffers, accessor, layout, numbers);
  return numbers;
}

}  // namespace

std::vector<double> read_gltf_numbers(const GltfObject& root, GltfBuffers& buffers, int index,
                                      std::size_t width) {
  const GltfObject accessor = accessor_of(root, index);
  return read_all(root, buffers, accessor, {width, accessor.boolean("normalized")});
}

std::vector<double> read_gltf_whole_numbers(const GltfObject& root, GltfBuffers& buffers, int index,
                                            std::size_t width) {
  const GltfObject accessor = accessor_of(root, index);
  check_index_type(accessor, component_of(accessor));
  return read_all(root, buffers, accessor, {width, false});
}

std::vector<Vec3d> read_gltf_positions(const GltfObject& root, GltfBuffers& buffers, int index) {
  const GltfObject accessor = accessor_of(root, index);
  if (component_of(accessor) == Component::uint32)
    accessor.fail("holds positions of 32-bit whole numbers", "floats are wanted");
  const std::vector<double> numbers = read_gltf_numbers(root, buffers, index, 3);
  std::vector<Vec3d> positions;
  positions.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    positions.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return positions;
}

std::vector<Vec2f> read_gltf_texture(const GltfObject& root, GltfBuffers& buffers, int index,
                                     std::size_t vertices) {
  const std::vector<double> numbers = read_gltf_numbers(root, buffers, index, 2);
  if (numbers.size() / 2 != vertices)
    accessor_of(root, index)
        .fail(
            fmt::format("has {} texture coordinates for {} vertices", numbers.size() / 2, vertices),
            "one for each is wanted");
  std::vector<Vec2f> texture;
  texture.reserve(vertices);
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    texture.push_back({static_cast<float>(numbers[i]), static_cast<float>(1 - numbers[i + 1])});
  return texture;
}

std::vector<int> read_gltf_indices(const GltfObject& root, GltfBuffers& buffers, int index,
                                   std::size_t vertices) {
  const GltfObject accessor = accessor_of(root, index);
  std::vector<int> indices;
  for (const double value : read_gltf_whole_numbers(root, buffers, index, 1)) {
    if (!(value < static_cast<double>(vertices)))
      accessor.fail(fmt::format("names vertex {} of {}", value, vertices),
                    "an existing vertex, counted from 0, is wanted");
    indices.push_back(static_cast<int>(value));
  }
  return indices;
}

}  // namespace weft
