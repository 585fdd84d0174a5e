#include "weft/image/io/metadata.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/core/hash.h"
#include "weft/core/json.h"
#include "weft/error.h"

namespace weft {
namespace {

using Json = nlohmann::json;

constexpr int deepest_nesting = 4;
// More would not fit into the largest image.
constexpr std::size_t max_charts = std::size_t{1} << 20U;
// Deflate shrinks by 1032 at most, the other compressions without loss by less.
constexpr std::size_t max_compression = 1032;

std::string checksum(const Json& without_checksum, const Planes3& cube) {
  const std::string text = json_text(without_checksum);
  Hash hash;
  hash.add(std::span<const char>(text));
  hash.add(cube.x);
  hash.add(cube.y);
  hash.add(cube.z);
  return hash.text();
}

// Reads the fields of the metadata, each checked for its type and range.
class Fields {
 public:
  Fields(std::string_view text, std::string_view where) : where_(where) {
    if (text == "positions")
      fail("positions of a frame, which do not tell what is joined",
           "the run's geometry image is wanted");
    try {
      json_ = parse_json(text, deepest_nesting);
    } catch (const JsonFault& fault) {
      fail(fmt::format("metadata with a fault: {}", fault.what()), "what weft wrote");
    }
    if (!json_.is_object()) fail("metadata that are no JSON object", "what weft wrote");
  }

  [[noreturn]] void fail(std::string_view found, std::string_view wanted) const {
    throw InputError(where_, found, wanted);
  }
  [[nodiscard]] const Json& json() const { return json_; }

  [[nodiscard]] const Json& at(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) fail(fmt::format("metadata without \"{}\"", key), "what weft wrote");
    return *found;
  }
  [[nodiscard]] int integer(const Json& value, const char* key) const {
    const bool fits = value.is_number_integer() && value.get<std::int64_t>() >= 0 &&
                      value.get<std::int64_t>() <= std::numeric_limits<int>::max();
    if (!fits)
      fail(fmt::format("metadata with \"{}\" out of range", key), "a whole number, not negative");
    return static_cast<int>(value.get<std::int64_t>());
  }
  [[nodiscard]] double number(const Json& value, const char* key) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      fail(fmt::format("metadata with \"{}\" that is no number", key), "a finite number");
    return value.get<double>();
  }
  [[nodiscard]] std::string text(const char* key) const {
    const Json& value = at(key);
    if (!value.is_string()) fail(fmt::format("metadata with \"{}\" that is no text", key), "text");
    return value.get<std::string>();
  }

 private:
  std::string_view where_;
  Json json_;
};

/// @return the version
int check_header(const Fields& fields, int size) {
  const int version = fields.integer(fields.at("version"), "version");
  if (version != single_chart_version && version != charts_version)
    fields.fail(fmt::format("geometry image of version {}", version),
                fmt::format("version {} or {}", single_chart_version, charts_version));
  const int told = fields.integer(fields.at("size"), "size");
  if (told != size)
    fields.fail(fmt::format("{} x {} samples with metadata for {} x {}", size, size, told, told),
                "a picture that was not resized");
  return version;
}

std::vector<Chart> read_charts(const Fields& fields) {
  const Json& list = fields.at("charts");
  if (!list.is_array() || list.empty() || list.size() > max_charts)
    fields.fail("metadata with bad \"charts\"", "a list of rectangles");
  std::vector<Chart> charts;
  for (const Json& item : list) {
    const auto number = [&](const char* key) {
      const auto found = item.find(key);
      if (found == item.end()) fields.fail("metadata with bad \"charts\"", "row, col, rows, cols");
      return fields.integer(*found, "charts");
    };
    const auto name = item.is_object() ? item.find("name") : item.end();
    if (!item.is_object() || name == item.end() || !name->is_string())
      fields.fail("metadata with bad \"charts\"", "objects that have a name");
    charts.push_back(
        {name->get<std::string>(), number("row"), number("col"), number("rows"), number("cols")});
  }
  return charts;
}

WorldMap read_world(const Fields& fields) {
  const Json& lower = fields.at("lower");
  if (!lower.is_array() || lower.size() != 3)
    fields.fail("metadata with a bad \"lower\"", "three numbers");
  const WorldMap world{{fields.number(lower[0], "lower"), fields.number(lower[1], "lower"),
                        fields.number(lower[2], "lower")},
                       fields.number(fields.at("scale"), "scale")};
  if (!(world.scale > 0))
    fields.fail(fmt::format("a world map of scale {}", world.scale), "a scale above 0");
  return world;
}

BorderMates read_mates(const Fields& fields, int size, int version, std::string_view where) {
  const Json& list = fields.at("mates");
  if (!list.is_array())
    fields.fail("metadata with bad \"mates\"", "a list of [first, mate, count]");
  std::vector<MateInterval> intervals;
  for (const Json& run : list) {
    const bool may_turn = version >= charts_version && run.size() == 4;
    if (!run.is_array() || (run.size() != 3 && !may_turn))
      fields.fail("metadata with bad \"mates\"", "a list of [first, mate, count]");
    intervals.push_back({fields.integer(run[0], "mates"), fields.integer(run[1], "mates"),
                         fields.integer(run[2], "mates"),
                         may_turn && fields.integer(run[3], "mates") != 0});
  }
  std::vector<Chart> charts;
  if (version >= charts_version) charts = read_charts(fields);
  try {
    if (version >= charts_version) return {size, std::move(charts), std::move(intervals)};
    return {size, std::move(intervals)};
  } catch (const InputError& error) {
    throw InputError(where, error.what(), "");
  }
}

std::string read_source_hash(const Fields& fields) {
  std::string hash = fields.text("source_hash");
  const bool plain = hash.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!plain || (!hash.empty() && hash.size() != 16))
    fields.fail("metadata with a bad \"source_hash\"", "16 hexadecimal digits or nothing");
  return hash;
}

void check_samples(const Fields& fields, const Planes3& cube) {
  const int n = cube.size();
  const auto inside = [](float value) { return value >= 0 && value <= 1; };  // false for NaN
  for (int row = 0; row < n; ++row)
    for (int col = 0; col < n; ++col) {
      const Vec3f p = cube.at(row, col);
      if (!inside(p.x) || !inside(p.y) || !inside(p.z))
        fields.fail(
            fmt::format("sample ({}, {}, {}) in row {}, column {}", p.x, p.y, p.z, row, col),
            "positions in [0, 1]");
    }
}

void check_checksum(const Fields& fields, const Planes3& cube) {
  Json rest = fields.json();
  const auto told = rest.find("checksum");
  if (told == rest.end()) return;
  const Json sum = *told;
  rest.erase("checksum");
  if (sum != checksum(rest, cube))
    fields.fail("samples or metadata that do not match their checksum", "a file as weft wrote it");
}

Json charts_json(const std::vector<Chart>& charts) {
  Json list = Json::array();
  for (const Chart& chart : charts)
    list.push_back({{"name", chart.name},
                    {"row", chart.row},
                    {"col", chart.col},
                    {"rows", chart.rows},
                    {"cols", chart.cols}});
  return list;
}

/// Samples of no chart follow the one that stands for them.
void fill_holes(GeometryImage& image) {
  for (int s = 0; s < image.size() * image.size() && !image.has_one_chart(); ++s)
    if (image.mates.is_hole(s)) image.cube.set(s, image.cube.at(image.mates.representative(s)));
}

}  // namespace

Planes3 stored_samples(const GeometryImage& image) {
  Planes3 stored = image.cube;
  for (int s = 0; s < image.size() * image.size() && !image.has_one_chart(); ++s)
    if (image.mates.is_hole(s)) stored.set(s, {});
  return stored;
}

std::string metadata_text(const GeometryImage& image) {
  Json mates = Json::array();
  for (const MateInterval& run : image.mates.intervals()) {
    mates.push_back({run.first, run.mate, run.count});
    if (run.turned) mates.back().push_back(1);
  }
  const Vec3d lower = image.world.lower;
  Json json{{"version", image.has_one_chart() ? single_chart_version : charts_version},
            {"size", image.size()},
            {"mates", std::move(mates)},
            {"lower", {lower.x, lower.y, lower.z}},
            {"scale", image.world.scale},
            {"source", image.source},
            {"source_hash", image.source_hash}};
  if (!image.has_one_chart()) json["charts"] = charts_json(image.mates.charts());
  json["checksum"] = checksum(json, stored_samples(image));
  return json_text(json);
}

BorderMates mates_in(std::string_view text, int size, std::string_view where) {
  const Fields fields(text, where);
  return read_mates(fields, size, check_header(fields, size), where);
}

GeometryImage assemble_image(Planes3 cube, std::string_view text, std::string_view where) {
  const Fields fields(text, where);
  const int version = check_header(fields, cube.size());
  GeometryImage image;
  image.world = read_world(fields);
  image.mates = read_mates(fields, cube.size(), version, where);
  image.source = fields.text("source");
  image.source_hash = read_source_hash(fields);
  check_samples(fields, cube);
  check_checksum(fields, cube);
  image.cube = std::move(cube);
  fill_holes(image);
  if (!mates_bit_equal(image))
    fields.fail("border mates with different positions", "an image whose samples were not edited");
  return image;
}

void require_image_size(std::int64_t width, std::int64_t height, std::string_view where) {
  if (width == height && width >= min_image_size && width <= largest_image_size) return;
  throw InputError(
      where, fmt::format("a picture of {} x {}", width, height),
      fmt::format("a square geometry image of side {} .. {}", min_image_size, largest_image_size));
}

void require_enough_bytes(int side, std::size_t bytes_per_sample, std::size_t file_size,
                          std::string_view where) {
  const std::size_t samples = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  if (samples * bytes_per_sample / max_compression <= file_size) return;
  throw InputError(where, fmt::format("{} bytes for a picture of {} x {}", file_size, side, side),
                   "a whole file is wanted");
}

}  // namespace weft
