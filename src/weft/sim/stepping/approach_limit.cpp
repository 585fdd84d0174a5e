#include "weft/sim/stepping/approach_limit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "weft/error.h"
#include "weft/geometry_image.h"
#include "weft/sim/stepping/cloth_gaps.h"

namespace weft {
namespace {

/// Approach of a body in a step, as a part of that which its substep was divided for, beyond which
/// the step is divided further. The mean over a substep hides no more in smooth motion.
constexpr double max_excess_approach = 1.5;

}  // namespace

void ApproachLimit::set_up() {
  int largest = min_image_size;
  gap_ = HUGE_VAL;
  for (const SimulatedCloth& cloth : loaded_.cloths) {
    largest = std::max(largest, cloth.model->size);
    gap_ = std::min(gap_, gap_of(*cloth.model));
  }
  reach_ = ClothReach(largest);
}

double ApproachLimit::wanted_parts(const Step& step) {
  double wanted = 1;
  const ApproachRule rule{gap_, step.length};
  for (const SimulatedCloth& cloth : loaded_.cloths) {
    reach_.place(cloth.state, step.length, gap_of(*cloth.model));
    for (std::size_t i = 0; i < loaded_.bodies.size(); ++i)
      if (const BlockMotion* motion = step.collider.motion_of(i))
        wanted = std::max(wanted, wanted_subdivisions(*motion, reach_, rule));
  }
  return wanted;
}

void ApproachLimit::check_speed(double subdivisions, int frame) const {
  if (subdivisions > max_subdivisions)
    throw SceneError(name_,
                     fmt::format("bodies pass cloth at up to {:.4g} m/s in frame {}, faster than "
                                 "it can be kept from them",
                                 loaded_.driven.fastest(), frame + 1),
                     fmt::format("{} substeps or more are wanted",
                                 std::ceil(scene_.substeps * subdivisions / max_subdivisions)));
}

int ApproachLimit::subdivisions(const Step& substep) {
  const double wanted = wanted_parts(substep);
  check_speed(wanted, substep.frame);
  return whole_subdivisions(wanted);
}

int ApproachLimit::required_level(const Step& step, int subdivisions) {
  const double wanted = wanted_parts(step);
  if (wanted <= max_excess_approach) return -1;
  check_speed(wanted * subdivisions, step.frame);
  return level_of(whole_subdivisions(wanted * subdivisions));
}

std::string ApproachLimit::caution(double substep_time) const {
  const double fastest = loaded_.driven.fastest();
  const double parts = ApproachRule{gap_, substep_time}.parts(fastest * substep_time);
  if (parts <= max_subdivisions) return {};
  return fmt::format(
      "bodies go up to {:.4g} m/s, faster than cloth can be kept from them; {} substeps "
      "or more are wanted",
      fastest, std::ceil(scene_.substeps * parts / max_subdivisions));
}

}  // namespace weft
