#include "weft/mesh/io/gltf_colours.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "weft/mesh/io/gltf_accessor.h"
#include "weft/mesh/io/gltf_surface.h"
#include "weft/mesh/io/texture_picture.h"

namespace weft {
namespace {

constexpr int clamp_to_edge = 33071;  ///< of a sampler's wrapS and wrapT
constexpr std::int64_t max_texture_sets = 8;

bool is_clamped(const GltfObject& root, const GltfObject& texture) {
  const std::optional<int> sampler = texture.index("sampler", root.count("samplers"));
  if (!sampler) return false;
  const GltfObject object = root.element("samplers", static_cast<std::size_t>(*sampler));
  return object.integer("wrapS", 0, INT32_MAX).value_or(0) == clamp_to_edge &&
         object.integer("wrapT", 0, INT32_MAX).value_or(0) == clamp_to_edge;
}

/// What is not a number is 0.
float unit(double value) { return value > 0 ? static_cast<float>(std::min(value, 1.0)) : 0.0F; }

}  // namespace

void GltfColours::add(const GltfObject& primitive, const GltfObject& attributes,
                      const std::vector<Triangle>& triangles, std::size_t vertices) {
  const Material material = material_of(primitive);
  colours_.part_of.insert(colours_.part_of.end(), triangles.size(), material.part);
  add_corners(attributes, triangles, vertices);
  add_texture(attributes, material, triangles, vertices);
}

SurfaceColours GltfColours::take() {
  if (!any_corners_) colours_.corners.clear();
  return std::move(colours_);
}

GltfColours::Material GltfColours::material_of(const GltfObject& primitive) {
  const std::optional<int> index = primitive.index("material", document_.root().count("materials"));
  if (!index) return {};
  const auto [known, is_new] = materials_.try_emplace(*index);
  if (is_new) known->second = read_material(*index);
  return known->second;
}

GltfColours::Material GltfColours::read_material(int index) {
  const GltfObject& root = document_.root();
  const GltfObject object = root.element("materials", static_cast<std::size_t>(index));
  const std::optional<GltfObject> surface = object.object("pbrMetallicRoughness");
  if (!surface) return {};
  SurfaceColours::Part part;
  const std::vector<double> base = surface->numbers("baseColorFactor", 4);
  if (!base.empty()) part.base = {unit(base[0]), unit(base[1]), unit(base[2])};
  const std::optional<GltfObject> use = surface->object("baseColorTexture");
  if (base.empty() && !use) return {};
  Material material{static_cast<int>(colours_.parts.size()), 0};
  if (use) {
    read_place(*use, material);
    const std::optional<int> number = use->index("index", root.count("textures"));
    if (!number) use->fail("has no index", "a texture is wanted");
    const GltfObject texture = root.element("textures", static_cast<std::size_t>(*number));
    part.picture = read_picture(texture);
    part.clamped = is_clamped(root, texture);
  }
  colours_.parts.push_back(part);
  return material;
}

/// Which texture coordinates a picture lies at, and how it is moved.
void GltfColours::read_place(const GltfObject& use, Material& material) {
  const auto set_of = [](const GltfObject& object) {
    return object.integer("texCoord", 0, max_texture_sets - 1);
  };
  material.texture_set = static_cast<int>(set_of(use).value_or(0));
  const std::optional<GltfObject> extensions = use.object("extensions");
  if (!extensions) return;
  const std::optional<GltfObject> moved = extensions->object("KHR_texture_transform");
  if (!moved) return;
  material.moved.emplace(*moved);
  material.texture_set = static_cast<int>(set_of(*moved).value_or(material.texture_set));
}

int GltfColours::read_picture(const GltfObject& texture) {
  const GltfObject& root = document_.root();
  const std::optional<int> index = texture.index("source", root.count("images"));
  if (!index) texture.fail("has no picture", "a PNG or JPEG picture is wanted");
  if (const auto known = pictures_.find(*index); known != pictures_.end()) return known->second;
  const GltfObject image = root.element("images", static_cast<std::size_t>(*index));
  const std::string called = fmt::format("{}: images[{}]", name_, *index);
  const std::optional<int> view = image.index("bufferView", root.count("bufferViews"));
  const std::optional<std::string> uri = image.text("uri");
  if (!view && !uri) image.fail("has no data", "a uri or a bufferView is wanted");
  if (view) {
    colours_.pictures.push_back(decode_texture(document_.buffers().view(*view), called));
  } else {
    colours_.pictures.push_back(decode_texture(document_.buffers().resource(image, *uri), called));
    if (const auto file = GltfBuffers::file_of(*uri)) colours_.files.push_back(*file);
  }
  return pictures_[*index] = static_cast<int>(colours_.pictures.size()) - 1;
}

/// Colours of three numbers or, with opacity, of four.
void GltfColours::add_corners(const GltfObject& attributes, const std::vector<Triangle>& triangles,
                              std::size_t vertices) {
  const GltfObject& root = document_.root();
  const std::optional<int> index = attributes.index("COLOR_0", root.count("accessors"));
  if (!index) {
    colours_.corners.insert(colours_.corners.end(), triangles.size(),
                            {Vec3f{1, 1, 1}, Vec3f{1, 1, 1}, Vec3f{1, 1, 1}});
    return;
  }
  any_corners_ = true;
  const GltfObject accessor = root.element("accessors", static_cast<std::size_t>(*index));
  const std::size_t width = accessor.text("type") == "VEC4" ? 4 : 3;
  const std::vector<double> numbers = read_gltf_numbers(root, document_.buffers(), *index, width);
  if (numbers.size() != width * vertices)
    accessor.fail(fmt::format("has {} colours for {} vertices", numbers.size() / width, vertices),
                  "one for each is wanted");
  const auto colour = [&](int v) {
    const double* at = numbers.data() + width * static_cast<std::size_t>(v);
    return Vec3f{unit(at[0]), unit(at[1]), unit(at[2])};
  };
  for (const auto& [a, b, c] : triangles)
    colours_.corners.push_back({colour(a), colour(b), colour(c)});
}

void GltfColours::add_texture(const GltfObject& attributes, const Material& material,
                              const std::vector<Triangle>& triangles, std::size_t vertices) {
  const GltfObject& root = document_.root();
  const std::optional<int> index =
      attributes.index(fmt::format("TEXCOORD_{}", material.texture_set), root.count("accessors"));
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  std::vector<Vec2f> texture = index
                                   ? read_gltf_texture(root, document_.buffers(), *index, vertices)
                                   : std::vector<Vec2f>(vertices, {none, none});
  if (material.moved)
    for (Vec2f& uv : texture) uv = (*material.moved)(uv);
  for (const auto& [a, b, c] : triangles)
    colours_.uv.push_back({texture[a], texture[b], texture[c]});
}

SurfaceColours gltf_colours(std::string_view bytes, std::string_view name,
                            const std::filesystem::path& folder) {
  GltfDocument document(bytes, name, folder);
  GltfColours colours(document, name);
  read_gltf_surface(document, &colours);
  SurfaceColours taken = colours.take();
  for (std::filesystem::path& file : taken.files) file = folder / file;
  return taken;
}

}  // namespace weft
