#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "weft/vec.h"

namespace weft {

/// 8-bit RGB, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< [height * width * 3]
};
/// @throws OutputError
void write_png(const std::filesystem::path& path, const Picture& picture);
/// @throws InputError
Picture read_png(const std::filesystem::path& path);

/// Part of a figure: a picture with a line of text below it.
struct Panel {
  Picture picture;
  std::string label;  ///< UTF-8
};
/// Whether the font of labels and legends (DejaVu Sans) can be read; else they are left blank.
bool has_font();

/// White between panels [pixels].
inline constexpr int panel_gap = 14;
/// The height of a line of labels, room around it included [pixels].
int label_height(int text_scale);

/// Panels side by side on white, centred vertically. The line for labels is left out if there are
/// none.
Picture in_a_row(const std::vector<Panel>& panels, int text_scale = 2);
/// Pictures below each other on white.
Picture in_a_column(const std::vector<Picture>& pictures);

/// Writes a movie file that appears only when complete: raw frames go through a pipe to ffmpeg,
/// which writes under a temporary name.
class MovieWriter {
 public:
  /// @param path  .mp4 or .gif  @param width, height  both even of an .mp4, whose colours are those
  /// of two pixels each way  @param frame_rate  [1/s]
  /// @throws OutputError when ffmpeg is missing or the place cannot be written; for odd sizes of an
  ///         .mp4
  MovieWriter(const std::filesystem::path& path, int width, int height, double frame_rate);
  MovieWriter(const MovieWriter&) = delete;
  MovieWriter& operator=(const MovieWriter&) = delete;
  /// Without `finish` nothing is left behind.
  ~MovieWriter();
  /// @param picture  of the size that the writer was made for
  /// @throws OutputError with the last line of ffmpeg's messages when it has failed
  void add(const Picture& picture);
  /// Ends the movie and puts it in its place. @throws OutputError
  void finish();

 private:
  struct Pipe;
  std::unique_ptr<Pipe> pipe_;
};

// Colours of drawings, display space, each channel in [0, 1], unless said otherwise.

/// From blue over white to red as the stretch goes from a quarter over one to four.
Vec3f stretch_colour(double stretch);
/// From pale yellow over red to nearly black as a share goes from 0 to 1.
Vec3f amount_colour(double share);
/// Clearly distinct colours, one for each curve of a cut.
Vec3f curve_colour(int index);
/// A display colour as linear light, approximately: what the renderer takes.
Vec3f linear_light(Vec3f display);

/// No-op outside the picture.
void set_pixel(Picture& picture, int x, int y, Vec3f colour);
/// A picture of one colour.
Picture blank_picture(int width, int height, Vec3f colour);
/// Copies a picture into another, its upper left corner at (x, y); what falls outside is left out.
void paste(Picture& picture, const Picture& part, int x, int y);

}  // namespace weft
