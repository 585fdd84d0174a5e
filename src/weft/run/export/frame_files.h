#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "weft/run/export/exported_surface.h"
#include "weft/run/export/motion_writer.h"

namespace weft {

/// PLY, binary little-endian: positions and normals as floats, colours as bytes, polygons.
class PlyFrames {
 public:
  explicit PlyFrames(const ExportedSurface& surface);
  [[nodiscard]] std::string encode(const MotionFrame& frame) const;

 private:
  std::string head_, faces_;  // the same for all frames
  std::vector<Triangle> triangles_;
  std::vector<std::array<std::uint8_t, 3>> colours_;  // [V], or none
};

/// VTK's XML PolyData, its arrays appended raw: positions, normals, polygons, and the time of the
/// frame.
class VtpFrames {
 public:
  VtpFrames(const ExportedSurface& surface, double frame_rate);
  [[nodiscard]] std::string encode(const MotionFrame& frame) const;

 private:
  double frame_rate_;
  std::size_t vertices_ = 0, polygons_ = 0;
  std::string connectivity_, offsets_;  // the same for all frames, with their lengths
  std::vector<Triangle> triangles_;
};

/// Text of a PVD file, which ParaView opens: the time of each frame's file.
/// @param folder  of the frames, beside the file
std::string pvd_text(const std::string& folder, const std::vector<std::string>& files,
                     double frame_rate);

/// All samples as a float32 EXR, R, G, B = x, y, z, bit for bit.
std::string exr_frame(const MotionFrame& frame);

/// Writes an OBJ: positions, texture coordinates where there are some, a smooth normal for each
/// vertex, polygons; of a garment also a group for each panel and a line for each seam. @param
/// points  [vertices]  @throws OutputError
void write_obj(const std::filesystem::path& path, const ExportedSurface& surface,
               std::span<const Vec3f> points);

}  // namespace weft
