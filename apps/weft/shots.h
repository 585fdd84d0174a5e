#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "weft/camera.h"
#include "weft/drawing.h"
#include "weft/picture.h"

namespace weft::app {

/// What is drawn into pictures of one size, alone or beside others: a run, a mesh, an image.
class Subject {
 public:
  Subject() = default;
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  virtual ~Subject() = default;

  /// Whether this is a flat picture, the same from every camera.
  [[nodiscard]] virtual bool is_flat() const { return false; }
  /// Number of frames; 1 for what does not move.
  [[nodiscard]] virtual int frames() const { return 1; }
  /// [1/s]
  [[nodiscard]] virtual double frame_rate() const { return 30; }
  /// Width over height of what a camera sees.
  [[nodiscard]] virtual double aspect() const = 0;
  /// Adds what a camera has to see at a frame.
  virtual void add_to(Outline& outline, int frame) const = 0;
  virtual Picture draw(int frame, const Camera& camera) = 0;
};

/// Subjects side by side with their names below, all seen from one camera.
class Shots {
 public:
  /// @param labels  a name for each subject, or none at all
  /// @param view    its size is that of each subject's picture
  Shots(std::vector<std::unique_ptr<Subject>> subjects, std::vector<std::string> labels,
        const ViewFrom& view);
  [[nodiscard]] bool any_flat() const;
  [[nodiscard]] bool any_moves() const;
  /// The largest number of frames of a subject, and the rate [1/s] of that which has it.
  [[nodiscard]] int frames() const;
  [[nodiscard]] double frame_rate() const;

  /// Draws one frame of all subjects, or the only one of those that do not move; the last of each
  /// for -1. The camera frames this alone.
  Picture still(int frame);
  /// A movie: how the camera moves, and which frames it sees.
  struct Take {
    int count = 1;              ///< of pictures
    double rate = 30;           ///< [1/s]
    bool turns = false;         ///< once around
    bool plays = false;         ///< or stands still at `frame`
    int frame = -1;             ///< as of `still`
    std::vector<Vec3d> points;  ///< that stay in sight
  };
  /// A take that plays runs at their own speeds; those that have ended stand still.
  /// @param max_rate  of the movie's pictures [1/s]
  [[nodiscard]] Take playing(double max_rate = 1000) const;
  /// A take of one turn of at least four seconds, at most 30 pictures a second. @param frame  to
  /// stand still at; none: what moves is played
  [[nodiscard]] Take turning(std::optional<int> frame) const;
  /// Picture i of a take.
  Picture draw(const Take& take, int i);

 private:
  [[nodiscard]] Outline outline_at(int frame) const;
  [[nodiscard]] Outline outline() const;
  Picture draw(const std::vector<int>& frames, double azimuth, const std::vector<Vec3d>& points);

  std::vector<std::unique_ptr<Subject>> subjects_;
  std::vector<std::string> labels_;
  ViewFrom view_;
};

/// The frame itself; the last one for -1 and for what does not move.
int frame_of(const Subject& subject, int frame);

/// The size of each of `count` pictures of a row with labels, so that the row has the view's size.
ViewFrom part_of_row(const ViewFrom& view, int count);

}  // namespace weft::app
