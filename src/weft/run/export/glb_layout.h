#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "weft/run/export/motion_writer.h"

namespace weft {

/// A surface in the form of glTF: one texture coordinate per vertex.
struct GlbMesh {
  std::vector<int> source;  ///< [W] the surface's vertex of each; starts with all of those, in
                            ///< order
  std::vector<Vec2f> uv;    ///< [W] v runs downwards; or empty
  std::vector<Triangle> triangles;
  std::vector<Vec3f> colours{};  ///< [W] linear RGB; or empty
};
GlbMesh glb_mesh(const ExportedSurface& surface);

/// Smallest and largest coordinates, which the format requires.
struct Extremes {
  Vec3f min, max;
};
Extremes extremes(const std::vector<Vec3f>& points);

struct GlbParts;

/// Layout of the binary part, in this order: positions, normals, uv, colours, triangles, then
/// positions and normals of each target, times and weights.
class GlbLayout {
 public:
  GlbLayout(const GlbMesh& mesh, const FinishedMotion& motion);

  [[nodiscard]] std::uint64_t bytes() const { return end_; }
  /// The JSON part. @param positions  of frame 0, then of each target
  [[nodiscard]] std::string json(const std::vector<Extremes>& positions) const;

 private:
  [[nodiscard]] nlohmann::ordered_json primitive(const std::vector<Extremes>& positions,
                                                 GlbParts& parts) const;
  [[nodiscard]] nlohmann::ordered_json views() const;
  /// @return the index of the view
  int add_view(std::uint64_t bytes);

  const GlbMesh& mesh_;
  const FinishedMotion& motion_;
  std::vector<std::uint64_t> starts_, sizes_;  // of each view
  std::uint64_t end_ = 0;
  int positions_ = 0, normals_ = 0, uv_ = -1, colours_ = -1, triangles_ = 0, targets_ = -1,
      times_ = -1, weights_ = -1;
};

}  // namespace weft
