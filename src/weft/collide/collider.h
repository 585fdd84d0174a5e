#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "weft/core/contact.h"
#include "weft/core/planes.h"
#include "weft/core/thread_team.h"
#include "weft/image/geometry_image.h"

namespace weft {

/// A body as placed in the scene.
struct Body {
  Planes3 positions;  ///< [n x n] world [m]
  BorderMates mates;
  double friction = 0.4;
};

/// The paper's angular table [zink07, section 5].
struct PolarMapOptions {
  int size = 0;  ///< cells a side of the table; 0: the body's image size
  /// From the surface point on the particle's ray, walk over neighbouring samples to the closest
  /// point, and push no deeper than a tenth of the body's side. False: the printed method, whose
  /// radial point may lie far from the closest one, so that single pushes are far too deep.
  bool walk = true;
};
using ColliderOptions = std::variant<PolarMapOptions>;
std::string_view name_of(const ColliderOptions& options);

/// What a collider needs to know of the cloth it guards.
struct Guarded {
  double thickness = 0.002;  ///< the gap that is kept [m]
  double friction = 0.4;     ///< of the cloth; of a pair: the geometric mean
};

/// The state of a cloth during a step, as far as a collider touches it.
struct MovingCloth {
  const Planes3& start;             ///< positions at the start of the step [m]
  Planes3& position;                ///< proposed [m]
  Planes3& velocity;                ///< proposed [m/s]
  const Grid<float>& inverse_mass;  ///< 0: pinned, never moved
};

/// Keeps a cloth out of bodies. Nothing allocates or throws once warmed up.
class Collider {
 public:
  Collider() = default;
  Collider(const Collider&) = delete;
  Collider& operator=(const Collider&) = delete;
  virtual ~Collider() = default;
  /// Contacts for the integrator's next iteration, from the proposal; empty for methods that only
  /// push. Ordered by sample. Valid until the next call.
  virtual std::span<const Contact> detect(const MovingCloth& cloth, ThreadTeam& team) noexcept = 0;
  /// The last change of positions in a step: pushes out what is inside, stops its inward velocity,
  /// and holds it by friction. Mates are treated alike, so they stay equal.
  /// @return how many particles (mates once or as samples: samples) were in contact
  virtual int correct(const MovingCloth& cloth, double time_step, ThreadTeam& team) noexcept = 0;
  /// The least signed distance of a particle to an obstacle (negative inside), for reports. Gaps to
  /// bodies are known up to twice the thickness only; infinite where nothing is known to be near.
  /// [m]
  virtual double smallest_gap(const Planes3& positions, ThreadTeam& team) noexcept = 0;
};

/// @param ground  height of the ground plane, if any; its friction is `ground_friction`
struct Obstacles {
  std::vector<Body> bodies;
  std::optional<double> ground;
  double ground_friction = 0.5;
};
std::unique_ptr<Collider> make_collider(const ColliderOptions& options, const Obstacles& obstacles,
                                        const Guarded& cloth);

}  // namespace weft
