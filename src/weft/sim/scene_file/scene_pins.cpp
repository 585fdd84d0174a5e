#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "weft/sim/scene_file/scene_parts.h"

namespace weft {
namespace {

Vec2d read_image_point(const nlohmann::json& value, const JsonPlace& place) {
  const std::vector<double> uv = numbers_of(value, place, 2);
  for (const double x : uv)
    if (x < 0 || x > 1)
      place.fail(fmt::format("[{}, {}]", uv[0], uv[1]), "u and v from 0 to 1 are wanted");
  return {uv[0], uv[1]};
}

MotionKey read_motion_key(const nlohmann::json& value, const JsonPlace& place) {
  const JsonObject object(value, place, scene_keys::motion_key);
  MotionKey key;
  key.time = object.number("time", 0, not_negative);
  key.rotate = object.vector("rotate", {});
  key.translate = object.vector("translate", {});
  return key;
}

PinPlace read_pin_place(const JsonObject& object) {
  const JsonPlace& place = object.place();
  const int ways = (object.has("image") ? 1 : 0) + (object.has("nearest") ? 1 : 0) +
                   (object.has("region") ? 1 : 0);
  if (ways != 1)
    place.fail(fmt::format("{} places", ways),
               "one of \"image\", \"nearest\" and \"region\" is wanted");
  if (const nlohmann::json* image = object.find("image"))
    return ImagePin{read_image_point(*image, place.key("image"))};
  if (object.has("nearest")) return NearestPin{object.vector("nearest", {})};
  const nlohmann::json& region = *object.find("region");
  const JsonPlace at = place.key("region");
  if (!region.is_array() || region.size() != 2)
    at.fail("no pair of points", "[[u0, v0], [u1, v1]] is wanted");
  const RegionPin pin{read_image_point(region[0], at.element(0)),
                      read_image_point(region[1], at.element(1))};
  if (pin.lower.x > pin.upper.x || pin.lower.y > pin.upper.y)
    at.fail("an empty region", "the first point below the second is wanted");
  return pin;
}

ScenePin read_pin(const nlohmann::json& value, const JsonPlace& place) {
  const JsonObject object(value, place, scene_keys::pin);
  return {read_pin_place(object), read_motion(object, "path")};
}

SceneAttachment read_attachment(const nlohmann::json& value, const JsonPlace& place) {
  const JsonObject object(value, place, scene_keys::attachment);
  const std::string body = object.text("body", "");
  if (body.empty()) place.key("body").fail("no body", "the name of a body is wanted");
  return {body, read_pin_place(object)};
}

/// Reads each element of a list; empty where the key is absent.
template <class Part>
std::vector<Part> read_places(const JsonObject& object, std::string_view key,
                              Part (*read)(const nlohmann::json&, const JsonPlace&)) {
  std::vector<Part> parts;
  const nlohmann::json* list = object.find(key);
  if (list == nullptr) return parts;
  const JsonPlace place = object.place().key(key);
  if (!list->is_array()) place.fail("no list", "a list of places is wanted");
  for (std::size_t i = 0; i < list->size(); ++i)
    parts.push_back(read((*list)[i], place.element(i)));
  return parts;
}

}  // namespace

std::vector<MotionKey> read_motion(const JsonObject& object, std::string_view key) {
  std::vector<MotionKey> path;
  const nlohmann::json* list = object.find(key);
  if (list == nullptr) return path;
  const JsonPlace place = object.place().key(key);
  if (!list->is_array() || list->empty())
    place.fail("no list of keys", "[{\"time\", \"rotate\", \"translate\"}, ...] is wanted");
  for (std::size_t i = 0; i < list->size(); ++i) {
    path.push_back(read_motion_key((*list)[i], place.element(i)));
    if (i > 0 && path[i].time <= path[i - 1].time)
      place.element(i).key("time").fail(fmt::format("{} after {}", path[i].time, path[i - 1].time),
                                        "ascending times are wanted");
  }
  return path;
}

std::vector<ScenePin> read_pins(const JsonObject& object) {
  return read_places<ScenePin>(object, "pins", read_pin);
}

std::vector<SceneAttachment> read_attachments(const JsonObject& object) {
  return read_places<SceneAttachment>(object, "attach", read_attachment);
}

}  // namespace weft
