#pragma once

#include <array>
#include <string_view>

namespace weft::scene_keys {

// What each object of a scene file may hold. `docs/scene.schema.json` lists the same (a test
// compares).

inline constexpr std::array<std::string_view, 13> scene{
    "version",    "gravity",  "frame_rate", "substeps", "frames", "ground", "wind",
    "integrator", "collider", "unit",       "up",       "cloths", "bodies"};
inline constexpr std::array<std::string_view, 3> wind{"velocity", "drag", "lift"};
inline constexpr std::array<std::string_view, 2> explicit_integrator{"type", "limiter_passes"};
inline constexpr std::array<std::string_view, 2> desbrun_integrator{"type", "limiter_passes"};
inline constexpr std::array<std::string_view, 3> newton_integrator{"type", "max_iterations",
                                                                   "tolerance"};
inline constexpr std::array<std::string_view, 3> implicit_integrator{"type", "max_iterations",
                                                                     "tolerance"};
inline constexpr std::array<std::string_view, 4> multigrid_integrator{
    "type", "limiter_passes", "max_iterations", "tolerance"};
inline constexpr std::array<std::string_view, 6> two_level_integrator{
    "type", "limiter_passes", "local_size", "global_size", "as_printed", "filter_stiffness"};
inline constexpr std::array<std::string_view, 1> pipeline_collider{"type"};
inline constexpr std::array<std::string_view, 3> polar_map_collider{"type", "size", "walk"};
inline constexpr std::array<std::string_view, 12> cloth{
    "name",     "surface",        "size",     "scale",    "rotate", "translate",
    "material", "self_collision", "friction", "velocity", "pins",   "attach"};
inline constexpr std::array<std::string_view, 10> body{
    "name",      "surface",  "size",   "scale",     "rotate",
    "translate", "friction", "motion", "animation", "lead_in"};
inline constexpr std::array<std::string_view, 8> material{"density",      "stretch",      "shear",
                                                          "bending",      "bend_springs", "damping",
                                                          "strain_limit", "thickness"};
inline constexpr std::array<std::string_view, 3> motion_key{"time", "rotate", "translate"};
inline constexpr std::array<std::string_view, 4> pin{"image", "nearest", "region", "path"};
inline constexpr std::array<std::string_view, 4> attachment{"body", "image", "nearest", "region"};

}  // namespace weft::scene_keys
