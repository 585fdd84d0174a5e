#pragma once

namespace weft::viewer {

/// Level of detail of the drawn scene: full where pictures are quick or nothing moves; coarser, and
/// with the light of earlier pictures, where a processor has to draw motion.
class Detail {
 public:
  /// Begins a picture. @param moves  whether anything differs from the picture before
  /// @param now  of any clock [s]
  void begin(bool moves, double now);
  /// Ends a picture. @param seconds  that it took
  void end(double seconds);

  /// Pixels of the window that one drawn pixel covers, along each side.
  [[nodiscard]] int pixel() const { return is_fine_ ? 1 : coarse_pixel_; }
  /// Whether the light of an earlier picture is reused.
  [[nodiscard]] bool keeps_light() const { return !is_fine_ && pictures_ % light_every != 0; }
  /// Whether the current picture should be drawn again, in full detail.
  [[nodiscard]] bool wants_finer(double now) const;
  /// Draws the next picture in full detail whatever it costs.
  void ask_for_fine() { fine_once_ = true; }

 private:
  static constexpr int light_every = 8;
  bool is_slow_ = false, is_fine_ = true, fine_once_ = false;
  int coarse_pixel_ = 2, pictures_ = 0;
  double moved_ = -1;  // time of the last motion [s]
};

}  // namespace weft::viewer
