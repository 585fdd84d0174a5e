#include "weft/mesh/io/gltf_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "weft/core/math.h"
#include "weft/mesh/io/gltf_accessor.h"
#include "weft/mesh/io/gltf_nodes.h"
#include "weft/mesh/io/polygon.h"

namespace weft {
namespace {

using Numbers = std::span<const double>;

/// Rotation between two of any length, the shorter way round.
/// @param value  [4] a unit quaternion
void between_rotations(double part, Numbers a, Numbers b, std::span<double> value) {
  const double size_a = quaternion_length(a), size_b = quaternion_length(b);
  double product = 0;
  for (std::size_t k = 0; k < 4; ++k) product += a[k] * b[k];
  std::array<double, 4> p{}, q{}, apart{}, sum{};
  for (std::size_t k = 0; k < 4; ++k) {
    p[k] = a[k] / size_a;
    q[k] = (product < 0 ? -b[k] : b[k]) / size_b;
    apart[k] = q[k] - p[k];
    sum[k] = p[k] + q[k];
  }
  // Exact for small angles, too, where the arc cosine of the product is not.
  const double angle = 2 * arc_tangent(quaternion_length(apart), quaternion_length(sum));
  const double sine_of_all = sine(angle);
  const bool small = angle < 1e-9;
  const double of_p = small ? 1 - part : sine((1 - part) * angle) / sine_of_all;
  const double of_q = small ? part : sine(part * angle) / sine_of_all;
  for (std::size_t k = 0; k < 4; ++k) value[k] = of_p * p[k] + of_q * q[k];
}

/// A cubic Hermite curve between two keys.
/// @param a  [3 * width] tangent in, value, tangent out of the first key; `b` the second's
/// @param seconds  between both
void between_tangents(double part, double seconds, Numbers a, Numbers b, std::span<double> value) {
  const double t = part, t2 = t * t, t3 = t2 * t;
  const std::size_t width = value.size();
  for (std::size_t k = 0; k < width; ++k)
    value[k] = (2 * t3 - 3 * t2 + 1) * a[width + k] +
               seconds * (t3 - 2 * t2 + t) * a[2 * width + k] + (3 * t2 - 2 * t3) * b[width + k] +
               seconds * (t3 - t2) * b[k];
}

Interpolation interpolation_of(const GltfObject& sampler) {
  const std::string name = sampler.text("interpolation").value_or("LINEAR");
  if (name == "LINEAR") return Interpolation::linear;
  if (name == "STEP") return Interpolation::step;
  if (name == "CUBICSPLINE") return Interpolation::cubic;
  sampler.fail(fmt::format("has the interpolation '{}'", name),
               "LINEAR, STEP or CUBICSPLINE is wanted");
}

/// The accessor that a sampler names under a key.
int accessor_of(const GltfObject& root, const GltfObject& sampler, std::string_view key) {
  const std::optional<int> index = sampler.index(key, root.count("accessors"));
  if (!index) sampler.fail(fmt::format("has no {}", key), "an accessor is wanted");
  return *index;
}

void check_finite(const GltfObject& sampler, const std::vector<double>& numbers) {
  for (const double value : numbers)
    if (!std::isfinite(value))
      sampler.fail("holds a number that is not finite", "finite numbers are wanted");
}

void check_directions(const GltfObject& sampler, const KeyCurve& curve) {
  const std::vector<double>& values = *curve.values;
  const bool cubic = curve.interpolation == Interpolation::cubic;
  for (std::size_t i = cubic ? 4 : 0; i < values.size(); i += cubic ? 12 : 4)
    if (!is_rotation({values[i], values[i + 1], values[i + 2], values[i + 3]}))
      sampler.fail("has a rotation without direction", "unit quaternions are wanted");
}

}  // namespace

void KeyCurve::evaluate(double seconds, std::span<double> value) const {
  const std::size_t keys = times->size();
  const auto next = std::upper_bound(times->begin(), times->end(), seconds);
  const auto after = static_cast<std::size_t>(next - times->begin());
  const std::size_t before = after == 0 ? 0 : after - 1;
  const bool cubic = interpolation == Interpolation::cubic;
  const std::size_t step = cubic ? 3 * width : width;
  const auto key = [&](std::size_t k) { return Numbers(*values).subspan(k * step, step); };
  if (after == 0 || after == keys || interpolation == Interpolation::step) {
    const Numbers held = key(before).subspan(cubic ? width : 0, width);
    std::copy(held.begin(), held.end(), value.begin());
    return;
  }
  const double between = (*times)[after] - (*times)[before];
  const double part = (seconds - (*times)[before]) / between;
  const Numbers a = key(before), b = key(after);
  if (cubic) return between_tangents(part, between, a, b, value);
  if (rotation) return between_rotations(part, a, b, value);
  for (std::size_t k = 0; k < width; ++k) value[k] = (1 - part) * a[k] + part * b[k];
}

KeyCurve CurveReader::read(std::size_t sampler, const CurveShape& shape) {
  const GltfObject object = animation_.element("samplers", sampler);
  KeyCurve curve;
  curve.interpolation = interpolation_of(object);
  curve.width = shape.width;
  curve.rotation = shape.rotation;
  curve.times = times(object);
  const std::size_t a_key = curve.interpolation == Interpolation::cubic ? 3 : 1;
  curve.values = values(object, shape, a_key * curve.times->size());
  if (shape.rotation) check_directions(object, curve);
  return curve;
}

CurveReader::Numbers CurveReader::times(const GltfObject& sampler) {
  const int index = accessor_of(document_.root(), sampler, "input");
  Numbers& known = times_[index];
  if (known) return known;
  const std::vector<double> read =
      read_gltf_numbers(document_.root(), document_.buffers(), index, 1);
  check_finite(sampler, read);
  for (std::size_t k = 0; k < read.size(); ++k)
    if (read[k] < 0 || (k > 0 && !(read[k] > read[k - 1])))
      sampler.fail(fmt::format("the time {} of key {} does not follow", read[k], k),
                   "ascending times from 0 on are wanted");
  return known = std::make_shared<const std::vector<double>>(read);
}

CurveReader::Numbers CurveReader::values(const GltfObject& sampler, const CurveShape& shape,
                                         std::size_t count) {
  const GltfObject& root = document_.root();
  const int index = accessor_of(root, sampler, "output");
  // Before its numbers are read, which may be many that are in no buffer.
  const std::size_t elements = static_cast<std::size_t>(
      root.element("accessors", static_cast<std::size_t>(index)).wanted("count", 1, max_elements));
  const std::size_t wanted = shape.lone_numbers ? count * shape.width : count;
  if (elements != wanted)
    sampler.fail(fmt::format("has {} values", elements),
                 fmt::format("{}, as its keys ask for, are wanted", wanted));
  Numbers& known = values_[index];
  if (known && known->size() == count * shape.width) return known;
  std::vector<double> read =
      read_gltf_numbers(root, document_.buffers(), index, shape.lone_numbers ? 1 : shape.width);
  check_finite(sampler, read);
  return known = std::make_shared<const std::vector<double>>(std::move(read));
}

}  // namespace weft
