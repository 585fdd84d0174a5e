#pragma once

#include <optional>
#include <vector>

#include "weft/cloth/cloth.h"
#include "weft/sim/sewing/gathers.h"
#include "weft/sim/sewing/sewing.h"
#include "weft/simulation.h"

namespace weft {

/// The cloths of a scene that are sewn from panels, until their seams are closed and what these
/// strained has slid to where it fits.
class Garments {
 public:
  /// All are kept by reference.
  /// @param sewing         of each cloth; none: it is no garment
  /// @param other_bending, gathers  of each cloth, see LoadedScene
  Garments(std::vector<SimulatedCloth>& cloths, std::vector<std::optional<Sewing>>& sewing,
           std::vector<BendingPlanes>& other_bending, std::vector<Gathers>& gathers)
      : cloths_(cloths), sewing_(sewing), other_bending_(other_bending), gathers_(gathers) {}

  /// Whether any is being sewn.
  [[nodiscard]] bool any_sewn() const;
  /// Whether a cloth is being sewn: a seam is open yet, or it slides.
  [[nodiscard]] bool is_sewn(std::size_t cloth) const {
    return is_open(cloth) || is_sliding(cloth);
  }
  [[nodiscard]] bool is_open(std::size_t cloth) const {
    return cloths_[cloth].model->apart.has_value();
  }
  /// Whether a cloth has no friction and is stiff: seams that close slide over what is between
  /// them, and panels do not crumple, until gravity acts on what stays open. Closed round a wider
  /// part of a body than they fit, seams slide on until they are tight no more: friction would hold
  /// them there, a waist on the hips.
  /// @param seconds  since the run's start
  [[nodiscard]] bool slides(std::size_t cloth, double seconds) const;
  /// The part of gravity that acts on a cloth.
  [[nodiscard]] double gravity_part(std::size_t cloth, double seconds) const;

  /// What a frame changes.
  struct Changes {
    bool fabric = false;   ///< of a cloth, which bends in another way, or is gathered further
    bool contact = false;  ///< other samples than before are joined, or friction begins
    double work = 0;       ///< of gathering edges [J]
  };
  /// Begins a frame: joins what has closed, takes apart what is to close anew, gathers edges, and
  /// gives garments the bending of their fabric where they no longer slide.
  /// @param seconds, length  at its start, and of it
  Changes begin_frame(double seconds, double length);
  /// Notes which cloths slide, as a collider that is made now knows them.
  void note_sliding(double seconds);
  /// Whether the collider knows a cloth as sliding.
  [[nodiscard]] bool is_sliding(std::size_t cloth) const { return sliding_[cloth] != 0; }

  /// Puts samples of seams in one place that proposals bring next to each other.
  void close(std::size_t cloth, ClothState& proposal) const {
    if (is_open(cloth)) sewing_[cloth]->close(proposal);
  }
  void pull(std::size_t cloth, const Sewing::Step& step) {
    sewing_[cloth]->pull(step, cloths_[cloth].state);
  }
  /// Contacts that keep seams of a cloth apart in a step, see Sewing; none where all are closed.
  [[nodiscard]] std::span<const Contact> contacts_between_seams(std::size_t cloth) const {
    return is_open(cloth) ? sewing_[cloth]->contacts_between_seams() : std::span<const Contact>();
  }
  /// Of each cloth whether it slides no more, since its seams have closed and fit.
  [[nodiscard]] const std::vector<char>& fitted() const { return fitted_; }
  void restore_fitted(const std::vector<char>& fitted) {
    fitted_ = fitted;
    fitted_.resize(cloths_.size());
  }
  /// Of each seam the largest distance in a pair. [m]
  [[nodiscard]] std::vector<double> gaps(std::size_t cloth) const;
  /// Of each seam the stretch of the cloth beside it, see Sewing.
  [[nodiscard]] std::vector<double> stretches(std::size_t cloth) const;

 private:
  /// @return whether other samples are joined than before
  bool join_closed(std::size_t cloth);

  std::vector<SimulatedCloth>& cloths_;
  std::vector<std::optional<Sewing>>& sewing_;
  std::vector<BendingPlanes>& other_bending_;
  std::vector<Gathers>& gathers_;
  std::vector<char> fitted_;   // of each cloth: whether its seams have closed and slid to a fit
  std::vector<char> sliding_;  // of each cloth: whether the collider's friction is none
};

}  // namespace weft
