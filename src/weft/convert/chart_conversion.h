#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/convert.h"
#include "weft/convert/pieces.h"
#include "weft/cut/cut_surface.h"
#include "weft/cut/open_to_disk.h"
#include "weft/param/chart_shape.h"

namespace weft {

/// A piece of a mesh on its way to a chart. The stages are called in the order in which they stand.
class ChartConversion {
 public:
  /// Cuts the piece open to a disk. All are kept by reference.
  /// @param input  the repaired mesh that the piece is of
  ChartConversion(const Piece& piece, const RepairedMesh& input, const std::string& name,
                  const ConvertOptions& options);

  /// The least side of an image that holds the cut as it is.
  [[nodiscard]] int min_side() const { return min_side_; }
  [[nodiscard]] const Cut& lengthened_cut() const { return shape().cut; }
  /// The least n = 2^k + 1 from 33 on that holds the cut well, with twice the border that its paths
  /// need at least, and samples enough for the piece: as many as it has vertices. More than 1025
  /// only where the cut needs them.
  [[nodiscard]] int suitable_side() const;

  /// Lengthens the cut where that betters the map to a square of `side` samples a side.
  void lengthen_cut(int side);
  /// Looks for a rectangle that the piece is clearly better mapped to than to that square, by trial
  /// maps along the plain and the lengthened cut. @pre the cut was lengthened for the square
  void choose_shape(int side);
  /// Gives the rectangle up where it is no longer better: what it shares with other charts has
  /// other intervals than it would choose. @pre it is taken
  /// @return whether it was given up
  bool reject_rectangle(ChartSize size);
  [[nodiscard]] bool has_rectangle() const { return rectangle_.trial.aspect > 1; }
  /// Takes the rectangle from now on, or the square. @pre for a rectangle: there is one
  void take_rectangle(bool taken);
  /// Of the shape that is taken, the longer side over the shorter one.
  [[nodiscard]] double aspect() const { return shape().trial.aspect; }
  /// Of that shape, what its stretch is worth in a chart of one cell, see ShapeTrial.
  [[nodiscard]] double energy() const { return shape().trial.energy; }
  /// What the borders of other charts share with this one's. @param border  kept by reference; its
  /// intervals may change until `map`
  void share(const FixedBorder& border);
  /// The curves that the border shares, once for every path along them.
  [[nodiscard]] const std::vector<int>& shared_curves() const { return shared_curves_; }
  /// The least number of intervals of all other paths together; 0: there is no other path.
  [[nodiscard]] int min_free_intervals() const { return min_free_intervals_; }
  /// Of all paths around the chart. [m]
  [[nodiscard]] double border_length() const { return border_length_; }
  /// Maps the disk to such a chart. @param unit  of rotations, see RotationOptions
  /// @throws TopologyError as map_to_square
  void map(ChartSize size, int unit);
  /// Threads may sample several charts at once. @param progress  may be null
  /// @throws TopologyError as sample_image
  void sample(Progress* progress);

  [[nodiscard]] std::shared_ptr<const MappedDisk> mapped() const { return mapped_; }
  [[nodiscard]] const GeometryImage& image() const { return image_; }
  [[nodiscard]] const CutSummary& cut() const { return cut_summary_; }
  [[nodiscard]] int rounds() const { return shape().rounds; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  [[nodiscard]] Cut first_cut();
  [[nodiscard]] CutDisk opened(const Cut& cut) const;
  [[nodiscard]] MappedDisk mapped_along(const Cut& cut, ChartSize size, int unit);

  const Piece& piece_;
  const RepairedMesh& input_;
  const std::string& name_;
  const ConvertOptions& options_;
  std::optional<CutSurface> surface_;  ///< of the piece; none once it is mapped
  /// A cut, and the shape of the chart that it is good for.
  struct Shape {
    Cut cut;
    int rounds = 0;  ///< paths added to it
    ShapeTrial trial;
  };
  [[nodiscard]] Shape& shape() { return takes_rectangle_ ? rectangle_ : square_; }
  [[nodiscard]] const Shape& shape() const { return takes_rectangle_ ? rectangle_ : square_; }

  Cut cut_;  ///< as it was found
  Shape square_, rectangle_;
  bool takes_rectangle_ = false;
  const FixedBorder* border_ = nullptr;
  std::vector<int> shared_curves_;
  int min_side_ = 0, min_free_intervals_ = 0;
  double border_length_ = 0;
  CutSummary cut_summary_;
  std::shared_ptr<MappedDisk> mapped_;
  GeometryImage image_;
  std::vector<std::string> warnings_;
};

}  // namespace weft
