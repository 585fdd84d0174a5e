#pragma once

namespace weft::viewer {

/// How finely the scene is drawn: as finely as can be where pictures are quick or nothing moves,
/// coarser and with light of some pictures ago where a processor has to draw them.
class Detail {
 public:
  /// Before a picture. @param moves  something differs from the picture before
  /// @param now  of any clock [s]
  void begin(bool moves, double now);
  /// After it. @param seconds  that it took
  void end(double seconds);

  /// Pixels of the window that one drawn pixel covers, along each side.
  [[nodiscard]] int pixel() const { return is_fine_ ? 1 : coarse_pixel_; }
  /// Whether older light is good enough.
  [[nodiscard]] bool keeps_light() const { return !is_fine_ && pictures_ % light_every != 0; }
  /// Whether the picture that stands there should be drawn again, finely.
  [[nodiscard]] bool wants_finer(double now) const;
  /// The next picture is fine whatever it costs.
  void ask_for_fine() { fine_once_ = true; }

 private:
  static constexpr int light_every = 8;
  bool is_slow_ = false, is_fine_ = true, fine_once_ = false;
  int coarse_pixel_ = 2, pictures_ = 0;
  double moved_ = -1;  // when something did last [s]
};

}  // namespace weft::viewer
