#include <array>
#include <cmath>
#include <string>

#include "weft/error.h"
#include "weft/mesh/io/coloured_files.h"
#include "weft/mesh/io/line_reader.h"

namespace weft {
namespace {

/// What is left of a line, without blanks round it: names of files may have blanks inside.
std::string rest_of_line(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == line.npos) return {};
  return std::string(line.substr(first, line.find_last_not_of(" \t\r") - first + 1));
}

/// The first word of a line, which is taken from it.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(" \t"));
  line.remove_prefix(word.size());
  return word;
}

/// A name as `usemtl` gives it: up to a comment, its blanks made single.
std::string material_name(std::string_view line) {
  LineReader reader(line, {});
  return reader.next_line() ? reader.rest_as_name() : std::string();
}

class MaterialReader {
 public:
  MaterialReader(std::string_view text, std::string_view name, NeighbourFiles& files,
                 SurfaceColours& colours)
      : text_(text), name_(name), files_(files), colours_(colours) {}

  ObjMaterials read() {
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      std::string_view line = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++number_;
      const std::string_view word = take_word(line);
      if (word == "newmtl") material_ = &materials_[material_name(line)];
      if (material_ == nullptr) continue;
      if (word == "Kd") read_colour(line);
      if (word == "map_Kd") read_picture(line);
    }
    return std::move(materials_);
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& wanted) const {
    throw InputError(std::string(name_) + ":" + std::to_string(number_), found, wanted);
  }

  void read_colour(std::string_view line) {
    std::array<float, 3> values{};
    for (float& value : values) {
      const std::string_view field = take_word(line);
      const std::optional<double> number = to_number(field.substr(0, field.find('\r')));
      if (!number || !(*number >= 0 && *number <= 1e6))
        fail("the colour " + in_quotes(field), "Kd red green blue, from 0 to 1, is wanted");
      value = static_cast<float>(*number);
    }
    if (material_->part.picture < 0)
      material_->part.base = linear_colour({values[0], values[1], values[2]});
  }

  /// One to three numbers, of which the third is of solid textures. @return missing ones as they
  /// were
  Vec2f read_pair(std::string_view option, std::string_view& line, Vec2f pair) const {
    for (int k = 0; k < 3; ++k) {
      std::string_view rest = line;
      const std::string_view field = take_word(rest);
      const std::optional<double> number = to_number(field);
      if (!number && k > 0) break;
      if (!number || !(std::abs(*number) <= 1e6))
        fail(in_quotes(field) + " behind " + std::string(option),
             "one to three numbers up to 1e6 are wanted");
      if (k < 2) (k == 0 ? pair.x : pair.y) = static_cast<float>(*number);
      line = rest;
    }
    return pair;
  }

  /// Reads the options that come before the file's name; others than these are stepped over.
  void read_picture(std::string_view line) {
    std::string_view rest = line;
    for (std::string_view word = take_word(rest); word.starts_with('-'); word = take_word(rest)) {
      if (word == "-t") fail("a picture with turbulence (-t)", "one that lies as it is is wanted");
      if (word == "-s") {
        material_->scale = read_pair(word, rest, {1, 1});
      } else if (word == "-o") {
        material_->offset = read_pair(word, rest, {});
      } else {
        if (word == "-clamp") material_->part.clamped = rest_of_line(rest).starts_with("on");
        take_word(rest);
        if (word == "-mm") take_word(rest);
      }
      line = rest;
    }
    const std::string file = rest_of_line(line);
    if (file.empty()) fail("a picture without name", "map_Kd FILE is wanted");
    material_->part.picture = files_.picture(file, colours_);
    material_->part.base = {1, 1, 1};
  }

  std::string_view text_, name_;
  NeighbourFiles& files_;
  SurfaceColours& colours_;
  int number_ = 0;
  ObjMaterial* material_ = nullptr;
  ObjMaterials materials_;
};

}  // namespace

ObjMaterials parse_materials(std::string_view text, std::string_view name, NeighbourFiles& files,
                             SurfaceColours& colours) {
  return MaterialReader(text, name, files, colours).read();
}

}  // namespace weft
