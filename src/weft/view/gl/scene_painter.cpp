#include "weft/view/gl/scene_painter.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include "weft/view/gl/light_shaders.h"
#include "weft/view/gl/surface_shaders.h"

namespace weft::gl {
namespace {

constexpr int key_size = 1024;
constexpr int sky_size = 256;
/// Approximate number of quads a side of grids in depth maps: each covers a few texels.
constexpr int key_quads = 128, sky_quads = 42;
/// Minimum number of quads a side of grids in pictures.
constexpr int min_quads = 128;
/// Offsets along the normal, in radii of the scene: larger than a texel of the depth maps.
constexpr double key_offset = 0.006;
constexpr double sky_offset = 0.016;
/// Texture units; 0 and 1 are the surface's positions and normals.
enum Unit {
  unit_front = 2,
  unit_back = 3,
  unit_key = 4,
  unit_compare = 5,
  unit_sky = 6,
  unit_colours = 7
};

constexpr std::string_view for_meshes = "#define MESH\n";

Program make_program(std::string_view name, std::string_view vertex,
                     std::initializer_list<std::string_view> fragment) {
  std::string text(shader_head);
  text += pixel_noise;
  for (const std::string_view part : fragment) text += part;
  return {name, std::string(shader_head).append(vertex), text};
}

Sampler make_sampler(GLenum compare, GLint filter) {
  GLuint name = 0;
  glGenSamplers(1, &name);
  glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, static_cast<GLint>(compare));
  glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
  glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return Sampler(name);
}

Box3d bounds(std::span<const SurfaceBuffers> surfaces) {
  Box3d box;
  for (const SurfaceBuffers& surface : surfaces) {
    if (surface.box().empty()) continue;
    box.add(surface.box().lower);
    box.add(surface.box().upper);
  }
  return box;
}

/// Sets the light of the key and of the open sky, both unshadowed.
void set_light_colours(const Program& program, const Lights& lights) {
  program.set("key_direction", vec_cast<float>(lights.key.back));
  program.set("key_light", key_colour);
  Vec3f open;
  for (int i = 0; i < sky_sides; ++i) open += lights.sky_direction[i].y * lights.sky_colour[i];
  program.set("open_sky", open);
}

}  // namespace

ScenePainter::ScenePainter()
    : depth_(make_program("depth", depth_vertex, {depth_fragment})),
      skylight_(make_program("skylight", fullscreen_vertex,
                             {"const int sky_taps = 4;\n", key_shadow, skylight_fragment})),
      floor_light_(make_program(
          "floor light", fullscreen_vertex,
          {"#define FLOOR\nconst int sky_taps = 8;\n", key_shadow, skylight_fragment})),
      backdrop_(make_program("backdrop", fullscreen_vertex, {screen_tools, backdrop_fragment})),
      surface_(
          make_program("surface", surface_vertex, {key_shadow, screen_tools, surface_fragment})),
      mesh_(make_program("mesh", std::string(for_meshes).append(surface_vertex),
                         {for_meshes, key_shadow, screen_tools, surface_fragment})),
      ground_(make_program("ground", surface_vertex, {key_shadow, screen_tools, ground_fragment})),
      edge_(make_program("edge", edge_vertex, {screen_tools, edge_fragment})),
      key_depth_(GL_DEPTH_COMPONENT32F, key_size, key_size),
      key_target_(make_framebuffer()),
      sky_depth_(sky_size, sky_sides),
      compare_(make_sampler(GL_COMPARE_REF_TO_TEXTURE, GL_LINEAR)),
      plain_(make_sampler(GL_NONE, GL_NEAREST)),
      nothing_(make_vertex_array()),
      edge_array_(make_vertex_array()),
      edge_ends_(make_buffer()) {
  glBindFramebuffer(GL_FRAMEBUFFER, key_target_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, key_depth_.name(), 0);
  glDrawBuffer(GL_NONE);
  glBindVertexArray(edge_array_.name());
  glBindBuffer(GL_ARRAY_BUFFER, edge_ends_.name());
  glVertexAttribIPointer(0, 2, GL_UNSIGNED_INT, 0, nullptr);
  glVertexAttribDivisor(0, 1);
  glEnableVertexAttribArray(0);
}

void ScenePainter::paint(const DrawnScene& scene, const Target& target) {
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  load(scene);
  const bool all_lit = std::all_of(surfaces_.begin(), surfaces_.end(),
                                   [](const SurfaceBuffers& surface) { return surface.is_lit(); });
  if (is_light_old_ && !(scene.keep_light && all_lit && scene.ground == ground_height_))
    renew_light(scene);
  draw_picture(scene, target);
}

void ScenePainter::renew_light(const DrawnScene& scene) {
  is_light_old_ = false;
  key_light_ = scene.light;
  ground_height_ = scene.ground;
  lights_ = make_lights(scene.light, bounds(surfaces_));
  if (scene.ground) load_floor(*scene.ground);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  draw_key_depth();
  draw_sky_depth();
  glDisable(GL_DEPTH_TEST);
  for (SurfaceBuffers& surface : surfaces_) {
    draw_skylight(surface, skylight_, 0.02F);
    surface.set_lit();
  }
  if (scene.ground) draw_skylight(floor_, floor_light_, 0.09F);
}

void ScenePainter::load(const DrawnScene& scene) {
  const std::size_t count = scene.surfaces.size() + scene.meshes.size();
  if (count != surfaces_.size() || scene.light != key_light_ || scene.ground != ground_height_)
    is_light_old_ = true;
  surfaces_.resize(count);
  auto next = surfaces_.begin();
  for (const DrawnSurface& surface : scene.surfaces)
    if ((next++)->load(surface)) is_light_old_ = true;
  for (const DrawnMesh& mesh : scene.meshes)
    if ((next++)->load(mesh)) is_light_old_ = true;
}

void ScenePainter::load_floor(double ground) {
  // The shadow of the scene's bounding sphere lies below it, away from the light.
  const double height = std::max(0.0, lights_.centre.y - ground);
  const Vec3d towards = lights_.key.back;
  const double away = height / std::max(0.2, towards.y);
  const Vec3d middle{lights_.centre.x - 0.5 * away * towards.x, ground,
                     lights_.centre.z - 0.5 * away * towards.z};
  floor_.load_ground(middle, 2.5 * lights_.radius + 0.7 * away);
}

void ScenePainter::draw_key_depth() {
  glBindFramebuffer(GL_FRAMEBUFFER, key_target_.name());
  glViewport(0, 0, key_size, key_size);
  glClear(GL_DEPTH_BUFFER_BIT);
  depth_.use();
  depth_.set("to_clip", parallel(lights_.key, lights_.centre, lights_.radius));
  for (SurfaceBuffers& surface : surfaces_) {
    surface.bind(depth_);
    surface.draw_about(key_quads);
  }
}

void ScenePainter::draw_sky_depth() {
  depth_.use();
  for (int i = 0; i < sky_sides; ++i) {
    sky_depth_.begin(i);
    depth_.set("to_clip", parallel(lights_.sky[i], lights_.centre, lights_.radius));
    for (SurfaceBuffers& surface : surfaces_) {
      surface.bind(depth_);
      surface.draw_about(sky_quads);
    }
  }
}

void ScenePainter::draw_skylight(const SurfaceBuffers& surface, const Program& program,
                                 float blur) {
  glBindFramebuffer(GL_FRAMEBUFFER, surface.sky_target().name());
  glViewport(0, 0, surface.sky_front().width(), surface.sky_front().height());
  program.use();
  set_lighting(program);
  surface.bind(program);
  sky_depth_.bind(unit_sky);
  program.set("sky_depth", unit_sky);
  program.set("sky_direction", std::span<const Vec3f>(lights_.sky_direction));
  program.set("sky_colour", std::span<const Vec3f>(lights_.sky_colour));
  std::array<Matrix, sky_sides> textures{};
  for (int i = 0; i < sky_sides; ++i)
    textures[i] = parallel_texture(lights_.sky[i], lights_.centre, lights_.radius);
  program.set("sky_texture", std::span<const Matrix>(textures));
  program.set("bounce", bounce_colour);
  program.set("offset", static_cast<float>(sky_offset * lights_.radius));
  program.set("blur", blur);
  program.set("width", surface.sky_front().width());
  program.set("height", surface.sky_front().height());
  glBindVertexArray(nothing_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void ScenePainter::draw_picture(const DrawnScene& scene, const Target& target) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  glViewport(0, 0, target.width, target.height);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const Vec3f size{static_cast<float>(target.width), static_cast<float>(target.height), 0};
  for (const Program* program : {&backdrop_, &surface_, &mesh_, &ground_, &edge_}) {
    program->use();
    program->set_pair("picture_size", size.x, size.y);
  }
  if (!scene.on_white) {
    backdrop_.use();
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glEnable(GL_DEPTH_TEST);
  const double away = length(scene.camera.eye - lights_.centre);
  const double near = std::max(away / 50, 1e-6 * lights_.radius);
  const Matrix to_clip =
      perspective(scene.camera, static_cast<double>(target.width) / target.height, near,
                  away + 16 * lights_.radius);
  draw_surfaces(scene, to_clip, target);
  if (scene.ground && scene.camera.eye.y > *scene.ground) draw_ground(to_clip);
  draw_edges(scene, to_clip, target);
}

void ScenePainter::set_lighting(const Program& program) const {
  set_light_colours(program, lights_);
  key_depth_.bind(unit_key);
  glBindSampler(unit_key, plain_.name());
  key_depth_.bind(unit_compare);
  glBindSampler(unit_compare, compare_.name());
  program.set("key_depth", unit_key);
  program.set("key_compare", unit_compare);
  program.set("key_texture", parallel_texture(lights_.key, lights_.centre, lights_.radius));
  program.set("key_offset", static_cast<float>(key_offset * lights_.radius));
}

void ScenePainter::draw_surfaces(const DrawnScene& scene, const Matrix& to_clip,
                                 const Target& target) {
  for (const Program* program : {&surface_, &mesh_}) {
    program->use();
    set_lighting(*program);
    program->set("to_clip", to_clip);
    program->set("eye", vec_cast<float>(scene.camera.eye));
    program->set("sky_front", unit_front);
    program->set("sky_back", unit_back);
  }
  surface_.use();
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const DrawnSurface& drawn = scene.surfaces[i];
    surface_.set("colour", drawn.colour);
    surface_.set("fabric", drawn.look == Look::fabric ? 1 : 0);
    surface_.set("threads", drawn.threads);
    surface_.set("colours", unit_colours);
    surfaces_[i].colours().bind(unit_colours);
    draw_lit(surfaces_[i], surface_, target);
  }
  mesh_.use();
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    SurfaceBuffers& mesh = surfaces_[scene.surfaces.size() + i];
    mesh_.set("fabric", 0);
    mesh_.set("colours", unit_colours);
    mesh.colours().bind(unit_colours);
    draw_lit(mesh, mesh_, target);
  }
}

void ScenePainter::draw_lit(SurfaceBuffers& surface, const Program& program, const Target& target) {
  surface.bind(program);
  surface.sky_front().bind(unit_front);
  surface.sky_back().bind(unit_back);
  // Normals are read for every pixel, so that quads of two or three pixels are small enough.
  surface.draw_about(std::max(min_quads, target.height / 3));
}

void ScenePainter::draw_ground(const Matrix& to_clip) {
  ground_.use();
  set_lighting(ground_);
  ground_.set("to_clip", to_clip);
  ground_.set("sky_front", unit_front);
  floor_.bind(ground_);
  floor_.sky_front().bind(unit_front);
  // Bodies that lie flat in the ground are seen.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1, 16);
  floor_.draw(1);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void ScenePainter::draw_edges(const DrawnScene& scene, const Matrix& to_clip,
                              const Target& target) {
  edge_.use();
  edge_.set("to_clip", to_clip);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const DrawnMesh& mesh = scene.meshes[i];
    const int vertices = static_cast<int>(mesh.mesh->positions.size());
    std::vector<GLuint> ends;
    for (const auto& [a, b] : mesh.marked_edges)
      if (std::min(a, b) >= 0 && std::max(a, b) < vertices)
        ends.insert(ends.end(), {static_cast<GLuint>(a), static_cast<GLuint>(b)});
    if (ends.empty()) continue;
    surfaces_[scene.surfaces.size() + i].bind(edge_);
    edge_.set("colour", mesh.mark_colour);
    const double width = mesh.mark_width * std::max(1.0, target.height / 480.0);
    edge_.set("half_width", static_cast<float>(width / 2));
    glBindVertexArray(edge_array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, edge_ends_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(ends.size() * sizeof(GLuint)),
                 ends.data(), GL_DYNAMIC_DRAW);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(ends.size() / 2));
  }
}

}  // namespace weft::gl
