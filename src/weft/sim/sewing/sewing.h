#pragma once

#include <array>
#include <span>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/contact.h"
#include "weft/garment.h"
#include "weft/sim/sewing/panel_motion.h"
#include "weft/sim/sewing/seam_stretch.h"
#include "weft/sim/sewing/seams_apart.h"
#include "weft/sim/sewing/unpicking.h"

namespace weft {

/// Brings together the samples of a garment's seams. In each step the samples of a class go towards
/// each other; otherwise they move as one particle. All distances shrink by the same part, so that
/// the cloth between needs to stretch nowhere. What is held back, by a body or other cloth, is then
/// closed from where its seam is closed already, as a zip is; it is let go and pulled again in
/// turn, so that cloth that was pulled into a crease, or to the wrong side of a limb, comes out of
/// it. Nothing is pulled into a body that it touches: seams slide over it, and where it is right in
/// their way those from which their panels hang go upwards. At a seam between a bodice and a skirt
/// the skirt comes to the height of the bodice. Where cloth holds a few samples apart, the seam is
/// taken apart next to them and closed anew.
class Sewing {
 public:
  /// The step that seams are pulled together in.
  struct Step {
    double length = 0;                        ///< [s]
    double seconds = 0;                       ///< at its start, since the run's
    std::span<const PastContact> contacts{};  ///< of the cloth in the last step
  };

  /// @param garment  kept by reference
  /// @param start  where its panels begin [n x n] [m]
  Sewing(const Garment& garment, const Planes3& start);

  /// Chooses what a frame takes apart again.
  /// @param seconds  at its start, since the run's  @param length  of the frame [s]
  void begin_frame(const Planes3& position, double seconds, double length);

  /// Sets the velocities of a cloth for the next step: in each class those of the mean, and towards
  /// each other. All are damped, as only the seams are to move the cloth.
  void pull(const Step& step, ClothState& state);

  /// The bending stiffness of a fabric while it is sewn: that of paper at least, so that panels
  /// come together as they are, instead of crumpling at their edges.
  [[nodiscard]] static WarpWeft bending_for(const Material& material);

  /// The part of their distances by which seams have closed, if nothing holds them back.
  [[nodiscard]] double part_closed(double seconds) const;

  /// The part of gravity that acts on the cloth: none while seams close, but not for ever.
  [[nodiscard]] double gravity_part(double seconds) const;

  /// Contacts of the step that `pull` began, between seams that are not to come between others.
  [[nodiscard]] std::span<const Contact> contacts_between_seams() const {
    return seams_apart_.contacts();
  }

  /// Puts the samples of each class at their mean, with their mean velocity, where they are next to
  /// each other: nearer once seams should have closed by the step that `pull` began, which comes
  /// first. Whether something is between is for the filter to find.
  void close(ClothState& state) const;
  /// The charts, joined where their seams have closed.
  [[nodiscard]] BorderMates joined(const Planes3& position) const;
  /// Whether the samples of every pair lie in one place.
  [[nodiscard]] bool is_closed(const Planes3& position) const;

  /// Of each seam how much longer the cloth beside it is than at rest, as a part: the largest
  /// stretch at each of its samples, on their mean.
  [[nodiscard]] std::vector<double> stretches(const Planes3& position) const {
    return stretch_.along(along_, position);
  }
  /// Whether cloth is stretched along any seam, as where that has closed round something wide.
  [[nodiscard]] bool is_tight(const Planes3& position) const;

  /// Of each seam the largest distance in a pair. [m]
  [[nodiscard]] std::vector<double> gaps(const Planes3& position) const;

 private:
  static constexpr int max_blocking = 3;  // normals that a sample heeds
  void find_classes_along_seams();
  [[nodiscard]] bool is_unpicked(int sample) const;
  void find_leaders();
  /// The mean over the samples of a class; its height is that of those that the others come to.
  [[nodiscard]] Vec3d mean_of_class(int index, const Planes3& planes) const;
  void measure(const Planes3& position);
  [[nodiscard]] bool is_with_body(const PastContact& contact) const;
  /// Finds the normals of the bodies that samples touch.
  void find_blocked(std::span<const PastContact> contacts);
  /// The velocity towards its mates that sewing gives a sample of a class: not into a body.
  [[nodiscard]] Vec3d pull_of(int index, int sample, const Planes3& position,
                              std::size_t step) const;
  /// What the bodies that a sample touches leave of a pull.
  [[nodiscard]] Vec3d along_bodies(int sample, Vec3d pull) const;
  /// Upwards along them: shorter than 1 the flatter they are.
  [[nodiscard]] Vec3d up_along_bodies(int sample) const;
  /// Finds the samples whose panels hang from them.
  void find_upper_edges(const Planes3& start);
  /// Where a class is put together late: no deeper in the bodies that it touches than it was when
  /// the step began. The filter would move each sample out by itself, some micrometres apart, and
  /// they would never be in one place.
  [[nodiscard]] Vec3d meeting_place(int index, Vec3d middle) const;
  /// Finds the mean of these velocities over the seams of each panel.
  void find_panel_pulls(const Planes3& position, std::size_t step);
  /// Finds the classes that are pulled once the seams should have closed.
  void find_next();
  [[nodiscard]] bool is_nearly_closed() const;
  /// The part of its distance that a class keeps in a step.
  [[nodiscard]] double kept_part(int index, double time_step, double seconds) const;

  const Garment& garment_;
  PanelMotion panels_;
  Unpicking unpicking_;
  double time_to_close_;                   // if nothing holds the seams back [s]
  bool late_ = false;                      // in this step all seams should have closed
  std::vector<std::vector<int>> leaders_;  // of each class, the samples that set the height
  std::vector<Vec3d> middle_;              // of each class
  std::vector<Vec3d> began_at_;            // of each class, its mean when the step began [m]
  std::vector<double> away_;               // distance of its farthest sample from there [m]
  std::vector<double> rate_;               // at which it shrinks [1/s]
  SeamStretch stretch_;
  SeamsApart seams_apart_;
  std::vector<int> class_of_;            // of each sample; -1: none
  std::vector<char> on_upper_edge_;      // of each sample: whether its panel hangs from it
  std::vector<std::vector<int>> along_;  // the classes along each seam
  std::vector<char> next_;               // of each class: whether it is pulled late
  std::vector<char> stuck_;              // of each class: whether cloth seems to hold it apart
  std::vector<std::array<Vec3f, max_blocking>> blocked_;  // of each sample, normals of bodies that
                                                          // it touches; 0 where there are fewer
};

}  // namespace weft
