#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "weft/convert.h"
#include "weft/convert/chart_conversion.h"
#include "weft/convert/chart_placement.h"
#include "weft/convert/pieces.h"
#include "weft/convert/seam_curves.h"

namespace weft {

/// The conversion of a repaired mesh, piece by piece, to one image.
class ImageConversion {
 public:
  /// Keeps references. @param made  its input is the repaired mesh
  /// @throws TopologyError when several pieces are to be cut by hand
  ImageConversion(Conversion& made, const std::string& name, const ConvertOptions& options);

  /// Cuts the pieces open and gives each its chart, unless these need a larger image than `most`.
  /// @return samples a side of the image  @throws TopologyError as the stages
  int place(int most);
  /// Then fills the rest of `made`, but for what is measured. @throws TopologyError as the stages
  void run();

 private:
  [[nodiscard]] ChartSize size_of(std::size_t chart) const {
    return {places_.charts[chart].rows, places_.charts[chart].cols};
  }
  void tell(std::string_view stage) const { update(options_.progress, stage, 0); }
  void cut(int most);
  void share_borders();
  void try_rectangles();
  [[nodiscard]] bool has_rectangles() const;
  void take_shapes(bool rectangles);
  std::optional<Placement> placed_as_rectangles(std::vector<std::string>& warnings);
  Placement placed_as_squares(std::vector<std::string>& warnings) const;
  bool reject_rectangles(const Placement& placement);
  [[nodiscard]] double stretch_in(const Placement& placement) const;
  void gather();
  [[nodiscard]] GeometryImage joined_image() const;
  [[nodiscard]] std::vector<MateInterval> seams() const;
  void sample_normal_map();
  void sample_textures();

  Conversion& made_;
  const std::string& name_;
  const ConvertOptions& options_;
  std::vector<Piece> pieces_;
  std::vector<ChartConversion> charts_;
  SeamCurves curves_;
  Placement places_;
};

}  // namespace weft
