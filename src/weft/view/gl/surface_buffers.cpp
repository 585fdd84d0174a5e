#include "weft/view/gl/surface_buffers.h"

#include <algorithm>
#include <cmath>

#include "weft/core/assert.h"
#include "weft/view/normals.h"

namespace weft::gl {
namespace {

/// Side of the light map of a grid of any size: soft light needs no more.
constexpr int light_samples = 129;
constexpr int mesh_columns = 1024;
constexpr int ground_side = 65;

bool is_finite(Vec3f p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

std::vector<Vec3f> packed(const Planes3& planes) {
  const int n = planes.size();
  std::vector<Vec3f> texels;
  texels.reserve(static_cast<std::size_t>(n) * n);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c) texels.push_back(planes.at(r, c));
  return texels;
}

/// Rows (or columns) of a chart that are drawn: every `step`, and always the last.
std::vector<int> kept_lines(int first, int count, int step) {
  std::vector<int> lines;
  for (int i = 0; i + 1 < count; i += step) lines.push_back(first + i);
  lines.push_back(first + count - 1);
  return lines;
}

/// The mesh without triangles of invalid indices.
TriangleMesh usable(const TriangleMesh& mesh) {
  TriangleMesh whole;
  whole.positions = mesh.positions;
  const int vertices = static_cast<int>(mesh.positions.size());
  for (const Triangle& t : mesh.triangles)
    if (std::all_of(t.begin(), t.end(), [&](int v) { return v >= 0 && v < vertices; }))
      whole.triangles.push_back(t);
  return whole;
}

/// The charts of a surface, or one that is all of it.
std::vector<Chart> charts_of(const DrawnSurface& surface) {
  const int side = surface.positions->size();
  if (surface.mates != nullptr && surface.mates->size() == side) return surface.mates->charts();
  return {{"", 0, 0, side, side}};
}

/// A side of the light map. Where there are several charts its texels are to lie on the samples, so
/// that nothing is interpolated from one chart to another.
int light_samples_of(std::span<const Chart> charts, int side) {
  if (charts.size() < 2) return light_samples;
  return std::max(1, (light_samples - 1) / (side - 1)) * (side - 1) + 1;
}

void fit(Texture& texture, GLenum format, int width, int height) {
  if (texture.width() != width || texture.height() != height)
    texture = Texture(format, width, height);
}

/// Uploads texels folded into rows of mesh_columns, the last row padded.
void upload_folded(Texture& texture, std::vector<Vec3f> texels) {
  const int rows =
      std::max<int>(1, (static_cast<int>(texels.size()) + mesh_columns - 1) / mesh_columns);
  texels.resize(static_cast<std::size_t>(rows) * mesh_columns);
  fit(texture, GL_RGB32F, mesh_columns, rows);
  texture.upload(texels);
}

}  // namespace

Planes3 without_holes(const Planes3& planes) {
  Planes3 whole = planes;
  Vec3f last;
  for (int r = 0; r < whole.size(); ++r)
    for (int c = 0; c < whole.size(); ++c) {
      const Vec3f p = whole.at(r, c);
      if (is_finite(p))
        last = p;
      else
        whole.set(r, c, last);
    }
  return whole;
}

IndexList::IndexList() : array_(make_vertex_array()), buffer_(make_buffer()) {}

void IndexList::upload(std::span<const GLuint> indices) {
  glBindVertexArray(array_.name());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_.name());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size_bytes()),
               indices.data(), GL_DYNAMIC_DRAW);
  count_ = static_cast<GLsizei>(indices.size());
}

void IndexList::draw_triangles() const {
  glBindVertexArray(array_.name());
  glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

bool SurfaceBuffers::load(const DrawnSurface& surface) {
  WEFT_ASSERT(surface.positions != nullptr && surface.positions->size() >= 2);
  if (surface.revision != 0 && surface.revision == revision_ && is_grid()) return false;
  revision_ = surface.revision;
  box_ = bounds(*surface.positions);
  const std::vector<Vec3f> white{{1, 1, 1}};
  const int colours = surface.colours != nullptr ? surface.colours->size() : 1;
  fit(colours_, GL_RGB32F, colours, colours);
  colours_.upload(surface.colours != nullptr ? packed(*surface.colours) : white);
  const Planes3 positions = without_holes(*surface.positions);
  upload_grid(
      positions,
      surface.normals != nullptr ? without_holes(surface.normals->normal)
                                 : grid_normals(positions, surface.mates),
      {charts_of(surface), surface.rising != nullptr ? *surface.rising : std::vector<char>()});
  const int light_side = light_samples_of(split_.charts, grid_side_);
  make_sky_target(light_side, light_side);
  return true;
}

void SurfaceBuffers::upload_grid(const Planes3& positions, const Planes3& normals,
                                 Triangulation split) {
  const int side = positions.size();
  fit(positions_, GL_RGB32F, side, side);
  fit(normals_, GL_RGB32F, normals.size(), normals.size());
  positions_.upload(packed(positions));
  normals_.upload(packed(normals));
  if (grid_side_ != side || split_ != split) triangles_.clear();
  grid_side_ = side;
  split_ = std::move(split);
}

bool SurfaceBuffers::load(const DrawnMesh& drawn) {
  WEFT_ASSERT(drawn.mesh != nullptr);
  if (drawn.revision != 0 && drawn.revision == revision_ && !is_grid()) return false;
  revision_ = drawn.revision;
  TriangleMesh mesh = usable(*drawn.mesh);
  box_ = box_of(mesh);
  for (Vec3d& p : mesh.positions)
    if (!is_finite(vec_cast<float>(p))) p = {};
  ShadedMesh shaded = shade_mesh(mesh);
  upload_folded(positions_, std::move(shaded.positions));
  upload_folded(normals_, std::move(shaded.normals));
  std::vector<Vec3f> colours(shaded.source.size(), drawn.colour);
  if (drawn.colours.size() == drawn.mesh->positions.size())
    for (std::size_t v = 0; v < colours.size(); ++v) colours[v] = drawn.colours[shaded.source[v]];
  upload_folded(colours_, std::move(colours));
  std::vector<GLuint> corners;
  corners.reserve(shaded.triangles.size() * 3);
  for (const Triangle& t : shaded.triangles)
    for (const int v : t) corners.push_back(static_cast<GLuint>(v));
  triangles_.clear();
  triangles_[1].upload(corners);
  grid_side_ = 0;
  make_sky_target(positions_.width(), positions_.height());
  return true;
}

void SurfaceBuffers::load_ground(Vec3d centre, double half_side) {
  Planes3 positions(ground_side);
  Planes3 normals(ground_side);
  for (int r = 0; r < ground_side; ++r)
    for (int c = 0; c < ground_side; ++c) {
      const Vec3d across{2.0 * c / (ground_side - 1) - 1, 0, 1 - 2.0 * r / (ground_side - 1)};
      positions.set(r, c, vec_cast<float>(centre + half_side * across));
      normals.set(r, c, {0, 1, 0});
    }
  upload_grid(positions, normals, {{{"", 0, 0, ground_side, ground_side}}, {}});
  make_sky_target(ground_side, ground_side);
}

void SurfaceBuffers::make_sky_target(int width, int height) {
  if (sky_front_.width() == width && sky_front_.height() == height) return;
  is_lit_ = false;
  sky_front_ = Texture(GL_RGBA16F, width, height);
  sky_back_ = Texture(GL_RGBA16F, width, height);
  sky_target_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, sky_target_.name());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, sky_front_.name(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, sky_back_.name(), 0);
  constexpr std::array<GLenum, 2> both{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(2, both.data());
}

/// Two triangles a quad; front faces are in the direction of du x dv.
std::vector<GLuint> SurfaceBuffers::quad_triangles(int step) const {
  std::vector<GLuint> indices;
  indices.reserve(static_cast<std::size_t>(grid_side_ / step + 1) * (grid_side_ / step + 1) * 6);
  for (const Chart& chart : split_.charts) {
    const std::vector<int> rows = kept_lines(chart.row, chart.rows, step);
    const std::vector<int> cols = kept_lines(chart.col, chart.cols, step);
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
      for (std::size_t j = 0; j + 1 < cols.size(); ++j) {
        const auto sample = [&](std::size_t row, std::size_t col) {
          return static_cast<GLuint>(rows[row] * grid_side_ + cols[col]);
        };
        const GLuint a = sample(i, j), b = sample(i, j + 1), c = sample(i + 1, j + 1),
                     d = sample(i + 1, j);
        const std::size_t quad = static_cast<std::size_t>(rows[i]) * (grid_side_ - 1) + cols[j];
        const bool given = step == 1 && !split_.rising.empty();
        if (given ? split_.rising[quad] != 0 : (i + j) % 2 == 0)
          indices.insert(indices.end(), {a, b, c, a, c, d});
        else
          indices.insert(indices.end(), {a, b, d, b, c, d});
      }
  }
  return indices;
}

void SurfaceBuffers::draw(int step) {
  const int lines = is_grid() ? std::clamp(step, 1, std::max(1, (grid_side_ - 1) / 4)) : 1;
  const auto [list, is_new] = triangles_.try_emplace(lines);
  if (is_new) list->second.upload(quad_triangles(lines));
  list->second.draw_triangles();
}

void SurfaceBuffers::draw_about(int quads) { draw((grid_side_ - 1) / quads); }

void SurfaceBuffers::bind(const Program& program) const {
  positions_.bind(0);
  normals_.bind(1);
  program.set("positions", 0);
  program.set("normals", 1);
  program.set("columns", positions_.width());
  program.set("rows", positions_.height());
}

}  // namespace weft::gl
