#pragma once

#include <string_view>

namespace weft::gl {

/// Vertex shader of surfaces: a vertex is only an index, from which its place in the grid follows.
/// On a grid, normals and light are read per pixel, on a mesh (MESH) at the vertices. Shadows are
/// computed per pixel on a mesh, whose vertices may be far apart, and at the edges of shadows on a
/// grid. Two programs, because software drivers execute both sides of every branch.
inline constexpr std::string_view surface_vertex = R"(
uniform sampler2D positions, normals, colours, sky_front, sky_back;
uniform int columns, rows;
uniform mat4 to_clip;
out vec3 world;
out vec2 uv;
#ifdef MESH
out vec3 own_colour;
out vec3 own_normal;
out vec3 own_front;
out vec3 own_back;
#endif
void main() {
  ivec2 at = ivec2(gl_VertexID % columns, gl_VertexID / columns);
  world = texelFetch(positions, at, 0).xyz;
  uv = vec2(at) / vec2(max(columns - 1, 1), max(rows - 1, 1));
#ifdef MESH
  own_colour = texelFetch(colours, at, 0).rgb;
  own_normal = texelFetch(normals, at, 0).xyz;
  own_front = texelFetch(sky_front, at, 0).rgb;
  own_back = texelFetch(sky_back, at, 0).rgb;
#endif
  gl_Position = to_clip * vec4(world, 1.0);
}
)";

/// Shading of fabric: wrapped diffuse, sheen of upright fibres [estevez17], and a plain weave along
/// the image's own coordinates that fades before it aliases. Of bodies: diffuse with a broad
/// highlight [walter07].
inline constexpr std::string_view surface_fragment = R"(
uniform bool fabric;
uniform vec3 eye, key_direction, key_light;
uniform float threads;
in vec3 world;
in vec2 uv;
out vec4 result;

#ifdef MESH
in vec3 own_colour;
in vec3 own_normal;
in vec3 own_front;
in vec3 own_back;
// The triangle's own normal, on the side of the vertices' one.
vec3 flat_normal() {
  vec3 n = cross(dFdx(world), dFdy(world));
  n = dot(n, n) > 0.0 ? normalize(n) : vec3(0.0, 1.0, 0.0);
  return dot(n, own_normal) < 0.0 ? -n : n;
}
vec3 outward() { return own_normal; }
vec3 albedo() { return own_colour; }
vec4 light_here(vec3 n) {
  vec3 lit_side = dot(flat_normal(), key_direction) < 0.0 ? -flat_normal() : flat_normal();
  float seen = key_visibility(world, lit_side, pixel_turn(), dot(n, key_direction) > 0.0);
  return vec4(gl_FrontFacing ? own_front : own_back, seen);
}
#else
uniform sampler2D normals, colours, sky_front, sky_back;
uniform vec3 colour;
vec3 albedo() { return colour * texture(colours, aligned(uv, textureSize(colours, 0))).rgb; }
vec3 outward() { return texture(normals, aligned(uv, textureSize(normals, 0))).xyz; }
// The light map tells where all or none of the key light is; in between it is found anew.
vec4 light_here(vec3 n) {
  vec2 at = aligned(uv, textureSize(sky_front, 0));
  vec4 light = gl_FrontFacing ? texture(sky_front, at) : texture(sky_back, at);
  bool between = light.a > 0.004 && light.a < 0.996;
  vec3 lit_side = dot(n, key_direction) < 0.0 ? -n : n;
  float seen = key_visibility(world, lit_side, pixel_turn(), between);
  return vec4(light.rgb, between ? seen : light.a);
}
#endif
// How bright a plain weave is at a point, 1 on average.
float weave(vec2 at) {
  vec2 q = at * threads;
  float wide = max(length(dFdx(q)), length(dFdy(q)));
  float seen = 1.0 - smoothstep(0.06, 0.22, wide);
  if (seen <= 0.0 || threads <= 0.0) return 1.0;
  vec2 across = abs(sin(3.14159265 * q));
  bool warp = mod(floor(q.x) + floor(q.y), 2.0) < 0.5;
  float height = warp ? across.x * (0.55 + 0.45 * across.y) : across.y * (0.55 + 0.45 * across.x);
  return mix(1.0, (warp ? 0.70 : 0.62) + 0.62 * height, seen);
}
vec3 fabric_light(vec3 n, vec3 v, vec3 key, vec3 sky) {
  vec3 own = albedo(), woven = own * weave(uv);
  float nl = dot(n, key_direction), nv = clamp(dot(n, v), 0.03, 1.0);
  float wrapped = max((nl + 0.2) / 1.2, 0.0);
  vec3 h = normalize(key_direction + v);
  float along = sqrt(max(1.0 - dot(n, h) * dot(n, h), 0.0));
  float fibres = (2.0 + 1.0 / 0.45) * pow(along, 1.0 / 0.45) / 6.2831853;
  float lit = clamp(nl, 0.0, 1.0);
  float sheen = fibres * lit / (4.0 * (lit + nv - lit * nv) + 0.05);
  vec3 tint = mix(vec3(1.0), own / max(max(own.r, max(own.g, own.b)), 1e-3), 0.6);
  float rim = pow(1.0 - nv, 3.0);
  return woven * (wrapped * key + sky) + 0.16 * tint * (sheen * key + rim * sky);
}
vec3 body_light(vec3 n, vec3 v, vec3 key, vec3 sky) {
  float nl = max(dot(n, key_direction), 0.0), nv = clamp(dot(n, v), 0.03, 1.0);
  vec3 h = normalize(key_direction + v);
  float a2 = 0.045, nh = max(dot(n, h), 0.0);
  float lobe = nh * nh * (a2 - 1.0) + 1.0;
  float shine = a2 / (lobe * lobe) / (4.0 * mix(nl * nv, nl + nv, 0.5) + 0.1);
  float mirror = 0.04 + 0.96 * pow(1.0 - max(dot(h, v), 0.0), 5.0);
  float rim = 0.03 + 0.22 * pow(1.0 - nv, 4.0);
  return albedo() * (nl * key + sky) + mirror * shine * nl * key + rim * sky;
}
void main() {
  vec3 n = outward();
  n = (gl_FrontFacing ? 1.0 : -1.0) * (dot(n, n) > 1e-12 ? normalize(n) : vec3(0.0, 1.0, 0.0));
  vec4 light = light_here(n);
  vec3 v = normalize(eye - world), key = key_light * light.a, sky = light.rgb;
  result = shown(fabric ? fabric_light(n, v, key, sky) : body_light(n, v, key, sky));
}
)";

inline constexpr std::string_view backdrop_fragment = R"(
out vec4 result;
void main() { result = dithered(shown(backdrop())); }
)";

/// The ground shows the backdrop darkened by shadow, which fades outwards, so that no edge of the
/// ground is visible.
inline constexpr std::string_view ground_fragment = R"(
uniform sampler2D sky_front;
uniform vec3 key_direction, key_light, open_sky;
in vec3 world;
in vec2 uv;
out vec4 result;
void main() {
  vec4 light = texture(sky_front, aligned(uv, textureSize(sky_front, 0)));
  vec3 key = key_direction.y * key_light;
  float seen = key_visibility(world, vec3(0.0, 1.0, 0.0), pixel_turn(), light.a < 0.999);
  vec3 kept = (seen * key + light.rgb) / (key + open_sky);
  float outward = length(2.0 * uv - 1.0);
  vec3 share = mix(kept, vec3(1.0), smoothstep(0.45, 1.0, outward));
  result = dithered(shown(backdrop() * share));
}
)";

/// Edges as strips of a width in pixels, extended by half of it at both ends so that they join.
inline constexpr std::string_view edge_vertex = R"(
uniform sampler2D positions;
uniform int columns;
uniform mat4 to_clip;
uniform vec2 picture_size;
uniform float half_width;  // [pixels]
layout(location = 0) in uvec2 ends;
void main() {
  int at[2] = int[2](int(ends.x), int(ends.y));
  vec4 clip[2];
  for (int i = 0; i < 2; ++i)
    clip[i] = to_clip * vec4(texelFetch(positions, ivec2(at[i] % columns, at[i] / columns), 0).xyz, 1.0);
  vec2 along = (clip[1].xy / clip[1].w - clip[0].xy / clip[0].w) * picture_size;
  along = dot(along, along) > 1e-12 ? normalize(along) : vec2(1.0, 0.0);
  int end = gl_VertexID / 2;
  vec2 shift = (end == 0 ? -along : along) + (gl_VertexID % 2 == 0 ? 1.0 : -1.0) * vec2(-along.y, along.x);
  vec4 place = clip[end];
  place.xy += 2.0 * half_width * shift / picture_size * place.w;
  place.z -= 2e-4 * abs(place.w);
  gl_Position = place;
}
)";
inline constexpr std::string_view edge_fragment = R"(
uniform vec3 colour;
out vec4 result;
void main() { result = shown(colour); }
)";

}  // namespace weft::gl
