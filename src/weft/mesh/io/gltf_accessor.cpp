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

/// @param width  components of an element: 1 to 3
Elements elements_of(const GltfObject& root, GltfBuffers& buffers, const GltfObject& accessor,
                     std::size_t width) {
  Elements elements;
  elements.component = static_cast<Component>(accessor.wanted("componentType", 5120, 5126));
  elements.normalized = accessor.boolean("normalized");
  const std::size_t size = width * size_of(elements.component);
  if (size == 0) accessor.fail("has an unknown componentType", "5120 .. 5123, 5125 or 5126");
  const char* type = width == 1 ? "SCALAR" : width == 2 ? "VEC2" : "VEC3";
  if (accessor.text("type") != type)
    accessor.fail("has another type", fmt::format("{} is wanted", type));
  if (accessor.has("sparse")) accessor.fail("is sparse", "plain data are wanted");
  const std::optional<int> view = accessor.index("bufferView", root.count("bufferViews"));
  if (!view) accessor.fail("has no data", "a bufferView, uncompressed, is wanted");
  const GltfObject view_object = root.element("bufferViews", static_cast<std::size_t>(*view));
  elements.stride = static_cast<std::size_t>(
      view_object.integer("byteStride", static_cast<std::int64_t>(size), 252)
          .value_or(static_cast<std::int64_t>(size)));
  const std::string_view bytes = buffers.view(*view);
  const auto offset = accessor.integer("byteOffset", 0, static_cast<std::int64_t>(bytes.size()));
  elements.bytes = bytes.substr(static_cast<std::size_t>(offset.value_or(0)));
  const std::size_t room =
      elements.bytes.size() < size ? 0 : (elements.bytes.size() - size) / elements.stride + 1;
  elements.count = static_cast<std::size_t>(accessor.wanted("count", 1, max_elements));
  if (elements.count > room)
    accessor.fail(fmt::format("has {} elements where {} fit", elements.count, room),
                  "a whole file is wanted");
  return elements;
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

}  // namespace

std::vector<Vec3d> read_gltf_positions(const GltfObject& root, GltfBuffers& buffers, int index) {
  const GltfObject accessor = accessor_of(root, index);
  const Elements elements = elements_of(root, buffers, accessor, 3);
  if (elements.component == Component::uint32)
    accessor.fail("holds positions of 32-bit whole numbers", "floats are wanted");
  std::vector<Vec3d> positions;
  positions.reserve(elements.count);
  for (std::size_t i = 0; i < elements.count; ++i)
    positions.push_back({number(elements, elements.at(i, 0)), number(elements, elements.at(i, 1)),
                         number(elements, elements.at(i, 2))});
  return positions;
}

std::vector<Vec2f> read_gltf_texture(const GltfObject& root, GltfBuffers& buffers, int index,
                                     std::size_t vertices) {
  const GltfObject accessor = accessor_of(root, index);
  const Elements elements = elements_of(root, buffers, accessor, 2);
  if (elements.count != vertices)
    accessor.fail(
        fmt::format("has {} texture coordinates for {} vertices", elements.count, vertices),
        "one for each is wanted");
  std::vector<Vec2f> texture;
  texture.reserve(elements.count);
  for (std::size_t i = 0; i < elements.count; ++i)
    texture.push_back({static_cast<float>(number(elements, elements.at(i, 0))),
                       static_cast<float>(1 - number(elements, elements.at(i, 1)))});
  return texture;
}

std::vector<int> read_gltf_indices(const GltfObject& root, GltfBuffers& buffers, int index,
                                   std::size_t vertices) {
  const GltfObject accessor = accessor_of(root, index);
  Elements elements = elements_of(root, buffers, accessor, 1);
  elements.normalized = false;  // has no meaning for vertex numbers
  if (elements.component != Component::uint8 && elements.component != Component::uint16 &&
      elements.component != Component::uint32)
    accessor.fail("holds vertex numbers of a wrong type", "5121, 5123 or 5125 is wanted");
  std::vector<int> indices;
  indices.reserve(elements.count);
  for (std::size_t i = 0; i < elements.count; ++i) {
    const double value = number(elements, elements.at(i, 0));
    if (!(value < static_cast<double>(vertices)))
      accessor.fail(fmt::format("names vertex {} of {}", value, vertices),
                    "an existing vertex, counted from 0, is wanted");
    indices.push_back(static_cast<int>(value));
  }
  return indices;
}

}  // namespace weft
