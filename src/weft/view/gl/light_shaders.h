#pragma once

#include <string_view>

namespace weft::gl {

/// Head of every shader; sky_sides is that of lights.h.
inline constexpr std::string_view shader_head = R"(#version 330 core
const int sky_sides = 18;
// A point of the square in a texture whose outermost texels' centres are the square's border.
vec2 aligned(vec2 uv, ivec2 size) { return (uv * vec2(size - 1) + 0.5) / vec2(size); }
)";

/// Gradient noise that differs from pixel to pixel, the same in every picture [jimenez14].
inline constexpr std::string_view pixel_noise = R"(
float pixel_noise() {
  return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}
)";

/// Covers the picture with one triangle.
inline constexpr std::string_view fullscreen_vertex = R"(
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";

/// Vertex shader for depth maps, from a packed plane of positions (the rows of a grid, or the
/// vertices of a mesh folded into rows).
inline constexpr std::string_view depth_vertex = R"(
uniform sampler2D positions;
uniform int columns;
uniform mat4 to_clip;
void main() {
  ivec2 at = ivec2(gl_VertexID % columns, gl_VertexID / columns);
  gl_Position = to_clip * vec4(texelFetch(positions, at, 0).xyz, 1.0);
}
)";
inline constexpr std::string_view depth_fragment = R"(
void main() {}
)";

/// Visibility of the key light at a point: percentage-closer soft shadows [fernando05] with taps on
/// a spiral, which is rotated from pixel to pixel by the noise in pictures.
inline constexpr std::string_view key_shadow = R"(
uniform sampler2D key_depth;
uniform sampler2DShadow key_compare;
uniform mat4 key_texture;
uniform float key_offset;  // along the normal [m]
float pixel_turn() { return 6.2831853 * pixel_noise(); }
const float light_width = 0.10;     // of the key light, as the tangent of its angle
const float widest_search = 0.025;  // in texture coordinates
const float deepest = 0.99999;     // nothing was drawn where the map is deeper
const vec2 few[8] = vec2[](
  vec2(0.2500, 0.0000), vec2(-0.3193, 0.2925), vec2(0.0489, -0.5569), vec2(0.4024, 0.5249),
  vec2(-0.7385, -0.1306), vec2(0.6996, -0.4450), vec2(-0.2340, 0.8705), vec2(-0.4463, -0.8593));
const vec2 many[24] = vec2[](
  vec2(0.1443, 0.0000), vec2(-0.1843, 0.1689), vec2(0.0282, -0.3215), vec2(0.2324, 0.3031),
  vec2(-0.4264, -0.0754), vec2(0.4039, -0.2569), vec2(-0.1351, 0.5026), vec2(-0.2577, -0.4961),
  vec2(0.5590, 0.2041), vec2(-0.5816, 0.2401), vec2(0.2803, -0.5991), vec2(0.2072, 0.6605),
  vec2(-0.6244, -0.3619), vec2(0.7325, -0.1610), vec2(-0.4470, 0.6359), vec2(-0.1033, -0.7970),
  vec2(0.6340, 0.5343), vec2(-0.8532, 0.0353), vec2(0.6223, -0.6193), vec2(-0.0416, 0.9004),
  vec2(-0.5922, -0.7096), vec2(0.9380, 0.1262), vec2(-0.7948, 0.5530), vec2(0.2172, -0.9654));
vec3 key_place(vec3 p, vec3 n) { return (key_texture * vec4(p + key_offset * n, 1.0)).xyz; }
bool key_sees(vec3 q) {
  return all(greaterThan(q.xy, vec2(0.0))) && all(lessThan(q.xy, vec2(1.0)));
}
// The surface's own plane falls or rises over the search; it must not count as hiding itself.
vec2 key_slope(vec3 n) {
  vec3 facing = mat3(key_texture) * n;
  return -facing.xy / min(facing.z, -0.25 * length(facing));
}
// Whether anything may throw a shadow near a point.
bool near_shadow(vec3 p, vec3 n) {
  vec3 q = key_place(p, n);
  vec2 slope = key_slope(n);
  bool hidden = false;
  for (int i = 0; i < 24; ++i) {
    vec2 aside = 1.5 * widest_search * many[i];
    hidden = hidden || texture(key_depth, q.xy + aside).r < min(q.z + dot(slope, aside), deepest);
  }
  return hidden && key_sees(q);
}
// n: to the side that is asked about; turn: of the spiral [rad]; 1 where not asked. Loops of no
// turns stand for branches: software drivers walk both ways of every branch.
float key_visibility(vec3 p, vec3 n, float turn, bool asked) {
  vec3 q = key_place(p, n);
  mat2 turned = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  vec2 slope = key_slope(n);
  float hidden = 0.0, depth = 0.0;
  int searched = asked && key_sees(q) ? 8 : 0;
  for (int i = 0; i < searched; ++i) {
    vec2 aside = widest_search * (turned * few[i & 7]);
    float d = texture(key_depth, q.xy + aside).r;
    if (d < min(q.z + dot(slope, aside), deepest)) { hidden += 1.0; depth += d; }
  }
  float width = clamp(light_width * (q.z - depth / max(hidden, 1.0)), 0.007, widest_search);
  float visible = 0.0;
  int taken = hidden > 0.5 ? 24 : 0;
  for (int i = 0; i < taken; ++i) {
    vec2 aside = width * (turned * many[i % 24]);
    visible += texture(key_compare, vec3(q.xy + aside, min(q.z + dot(slope, aside), deepest)));
  }
  return taken > 0 ? visible / 24.0 : 1.0;
}
)";

/// Skylight in image space: for every sample, the light on its two sides from every visible sky
/// direction and from the ground (RGB), and the visibility of the key light (A). The image is its
/// own light map. For the ground (FLOOR), A only tells where shadow may fall (0): its pixels
/// compute it anew.
inline constexpr std::string_view skylight_fragment = R"(
uniform sampler2D positions, normals;
uniform sampler2DArrayShadow sky_depth;
uniform vec3 sky_direction[sky_sides];
uniform vec3 sky_colour[sky_sides];
uniform mat4 sky_texture[sky_sides];
uniform vec3 bounce;
uniform float offset;  // away from the surface, so that it does not hide itself [m]
uniform float blur;    // of the shadows, in texture coordinates
uniform int width, height;
uniform vec3 key_direction;
layout(location = 0) out vec4 front;
layout(location = 1) out vec4 back;
void main() {
  vec2 uv = (gl_FragCoord.xy - 0.5) / vec2(max(width - 1, 1), max(height - 1, 1));
  vec3 p = texture(positions, aligned(uv, textureSize(positions, 0))).xyz;
  vec3 n = texture(normals, aligned(uv, textureSize(normals, 0))).xyz;
  n = dot(n, n) > 1e-12 ? normalize(n) : vec3(0.0, 1.0, 0.0);
  front = back = vec4(0.0);
  float open = 0.0;
  for (int i = 0; i < sky_sides; ++i) {
    float c = dot(n, sky_direction[i]);
    vec3 q = (sky_texture[i] * vec4(p + (c < 0.0 ? -offset : offset) * n, 1.0)).xyz;
    bool outside = any(lessThan(q.xy, vec2(0.0))) || any(greaterThan(q.xy, vec2(1.0)));
    float visible = 0.0;
    for (int tap = 0; tap < sky_taps; ++tap)
      visible += texture(sky_depth, vec4(q.xy + blur * few[tap], float(i), q.z));
    visible = outside ? 1.0 : visible / float(sky_taps);
    open += visible / float(sky_sides);
    front.rgb += max(c, 0.0) * visible * sky_colour[i];
    back.rgb += max(-c, 0.0) * visible * sky_colour[i];
  }
  float lit = 0.15 + 0.85 * open;
  front.rgb += bounce * (0.5 - 0.5 * n.y) * lit;
  back.rgb += bounce * (0.5 + 0.5 * n.y) * lit;
#ifdef FLOOR
  front.a = near_shadow(p, n) ? 0.0 : 1.0;
#else
  front.a = back.a = key_visibility(p, dot(n, key_direction) < 0.0 ? -n : n, 0.0, true);
#endif
}
)";

/// Backdrop, and the tone curve from light to display values.
inline constexpr std::string_view screen_tools = R"(
uniform vec2 picture_size;
vec3 backdrop() {
  vec2 at = gl_FragCoord.xy / picture_size - vec2(0.5, 0.52);
  float far = dot(at, at * vec2(1.0, 1.25));
  return mix(vec3(0.93, 0.935, 0.94), vec3(0.50, 0.515, 0.54), smoothstep(0.0, 0.75, far));
}
// Nearly straight in the dark, rolling off towards white [reinhard02, eq. 4], then sRGB.
vec4 shown(vec3 light) {
  vec3 c = max(light, vec3(0.0));
  c = c * (1.0 + c / 6.0) / (1.0 + 0.40 * c);
  c = clamp(c, 0.0, 1.0);
  vec3 high = 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055;
  return vec4(mix(12.92 * c, high, vec3(greaterThan(c, vec3(0.0031308)))), 1.0);
}
// Breaks up the steps of 8 bits in wide smooth places.
vec4 dithered(vec4 c) { return vec4(c.rgb + (pixel_noise() - 0.5) / 255.0, c.a); }
)";

}  // namespace weft::gl
