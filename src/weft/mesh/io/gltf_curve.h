#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "weft/mesh/io/gltf_document.h"

namespace weft {

/// How a curve goes between its keys.
enum class Interpolation { linear, step, cubic };

/// Keyframes of a property: constant before the first key and after the last [gltf20, appendix C].
struct KeyCurve {
  Interpolation interpolation = Interpolation::linear;
  std::size_t width = 1;  ///< numbers of a value; 4 with `rotation`
  bool rotation = false;  ///< values are quaternions x, y, z, w, and linear means spherical
  std::shared_ptr<const std::vector<double>> times;   ///< [K] ascending [s]
  std::shared_ptr<const std::vector<double>> values;  ///< [K * width]; cubic: [K * 3 * width], each
                                                      ///< key's tangent in, value, tangent out

  [[nodiscard]] double end() const { return times->back(); }
  /// @param value  [width] of a rotation not always a unit quaternion, with `cubic` maybe 0
  void evaluate(double seconds, std::span<double> value) const;
};

/// What an animation's channel asks of the sampler that it names.
struct CurveShape {
  std::size_t width = 1;
  bool rotation = false;
  bool lone_numbers = false;  ///< values are `width` elements of one number each, as of weights
};

/// Reads the curves of an animation; accessors that several of them share are read once.
class CurveReader {
 public:
  CurveReader(GltfDocument& document, GltfObject animation)
      : document_(document), animation_(std::move(animation)) {}
  /// @param sampler  @pre below the animation's count("samplers")
  /// @throws InputError for times that do not ascend from 0 or later, another number of values than
  ///         keys ask for, numbers that are not finite, rotations without direction
  KeyCurve read(std::size_t sampler, const CurveShape& shape);

 private:
  using Numbers = std::shared_ptr<const std::vector<double>>;
  Numbers times(const GltfObject& sampler);
  Numbers values(const GltfObject& sampler, const CurveShape& shape, std::size_t count);

  GltfDocument& document_;
  GltfObject animation_;
  std::map<int, Numbers> times_, values_;  ///< by accessor
};

}  // namespace weft
