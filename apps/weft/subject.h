#pragma once

#include "weft/camera.h"
#include "weft/picture.h"

namespace weft::app {

/// What is drawn into pictures of one size, alone or beside others: a run, a mesh, an image.
class Subject {
 public:
  Subject() = default;
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  virtual ~Subject() = default;

  /// A flat picture, the same from everywhere.
  [[nodiscard]] virtual bool is_flat() const { return false; }
  /// 1 for what does not move.
  [[nodiscard]] virtual int frames() const { return 1; }
  /// [1/s]
  [[nodiscard]] virtual double frame_rate() const { return 30; }
  /// Width over height of what a camera sees.
  [[nodiscard]] virtual double aspect() const = 0;
  /// Adds what a camera has to see at a frame.
  virtual void add_to(Outline& outline, int frame) const = 0;
  virtual Picture draw(int frame, const Camera& camera) = 0;
};

}  // namespace weft::app
