#pragma once

#include <string>

namespace weft::test {

/// Two rectangles, `width` by `height` centimetres, that face each other `apart` centimetres apart
/// about the y axis, from `low` up.
/// @param stitches  of the edges of `front` and `back`  @param label  of both upper edges; may be
/// empty
inline std::string two_panels(double width, double height, double apart, double low,
                              const std::string& stitches, const std::string& label = "") {
  const std::string upper = label.empty() ? "" : R"(,"label":")" + label + '"';
  const auto panel = [&](double z, bool back) {
    const std::string w = std::to_string(width), h = std::to_string(height);
    const std::string corners = back ? "[[0,0],[0," + h + "],[" + w + "," + h + "],[" + w + ",0]]"
                                     : "[[0,0],[" + w + ",0],[" + w + "," + h + "],[0," + h + "]]";
    return R"({"vertices":)" + corners + R"(,"edges":[{"endpoints":[0,1]},{"endpoints":[1,2])" +
           (back ? upper : "") + R"(},{"endpoints":[2,3])" + (back ? "" : upper) +
           R"(},{"endpoints":[3,0]}],)" + R"("translation":[)" + std::to_string(-width / 2) + "," +
           std::to_string(low) + "," + std::to_string(z) + R"(],"rotation":[0,0,0]})";
  };
  return R"({"pattern":{"panels":{"back":)" + panel(-apart / 2, true) + R"(,"front":)" +
         panel(apart / 2, false) + R"(},"stitches":[)" + stitches +
         R"(]},"properties":{"units_in_meter":100}})";
}

/// The same, sewn to a tube along both sides.
inline std::string tube_pattern(double width, double height, double apart, double low,
                                const std::string& label = "") {
  return two_panels(width, height, apart, low,
                    R"([{"panel":"front","edge":1},{"panel":"back","edge":2}],)"
                    R"([{"panel":"front","edge":3},{"panel":"back","edge":0}])",
                    label);
}

/// A rectangle, `width` by `height` centimetres, sewn to itself along both sides; from `low` up,
/// `before` the y axis.
inline std::string band_pattern(double width, double height, double low, double before) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  return R"({"pattern":{"panels":{"band":{"vertices":[[0,0],[)" + w + ",0],[" + w + "," + h +
         "],[0," + h +
         R"(]],"edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}],)"
         R"("translation":[)" +
         std::to_string(-width / 2) + "," + std::to_string(low) + "," + std::to_string(before) +
         R"(],"rotation":[0,0,0]}},"stitches":[[{"panel":"band","edge":1},{"panel":"band","edge":3}]]},)"
         R"("properties":{"units_in_meter":100}})";
}

/// Two panels as those of the tube, sewn along their upper edges, from which both hang.
inline std::string cape_pattern(double width, double height, double apart, double low) {
  return two_panels(width, height, apart, low,
                    R"([{"panel":"front","edge":2},{"panel":"back","edge":1}])");
}

/// A skirt panel with a slit of 25 cm from its lower side, and a triangle to be sewn into it, whose
/// corner comes to lie in the middle of a seam.
inline std::string godet_pattern() {
  return R"({"pattern":{"panels":{
    "skirt":{"vertices":[[0,0],[20,0],[20.1,25],[20.2,0],[40,0],[40,50],[0,50]],
      "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},
               {"endpoints":[4,5]},{"endpoints":[5,6]},{"endpoints":[6,0]}],
      "translation":[-20,100,0],"rotation":[0,0,0]},
    "godet":{"vertices":[[0,0],[16,0],[8,24]],
      "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,0]}],
      "translation":[-8,100,5],"rotation":[0,0,0]}},
    "stitches":[[{"panel":"godet","edge":2},{"panel":"skirt","edge":1}],
                [{"panel":"godet","edge":1},{"panel":"skirt","edge":2}]]},
    "properties":{"units_in_meter":100}})";
}

/// A rectangle, 20 cm wide.
/// @param low   its lowest edge [cm]  @param label  of its upper one; may be empty
/// @param turn  about the y axis [degrees]  @param height  [cm]
inline std::string panel_20_wide(double low, const std::string& label, double turn = 0,
                                 double height = 20) {
  const std::string h = std::to_string(height);
  return R"({"vertices":[[0,0],[20,0],[20,)" + h + "],[0," + h +
         R"(]],"edges":[{"endpoints":[0,1]},)"
         R"({"endpoints":[1,2]},{"endpoints":[2,3],"label":")" +
         label + R"("},{"endpoints":[3,0]}],"translation":[0,)" + std::to_string(low) +
         R"(,0],"rotation":[0,)" + std::to_string(turn) + ",0]}";
}

/// Two squares of 20 cm one above the other, 10 cm apart, to be sewn together: a top with the label
/// of its upper edge, and a skirt with that of its own.
inline std::string top_and_skirt(const std::string& top, const std::string& skirt) {
  return R"({"pattern":{"panels":{"top":)" + panel_20_wide(130, top) + R"(,"skirt":)" +
         panel_20_wide(100, skirt) +
         R"(},"stitches":[[{"panel":"top","edge":0},{"panel":"skirt","edge":2}]]},)" +
         R"("properties":{"units_in_meter":100}})";
}

/// A square of 20 cm from 1 m up that is sewn to nothing and held by no label.
inline std::string loose_square() {
  return R"({"pattern":{"panels":{"square":)" + panel_20_wide(100, "") +
         R"(},"stitches":[]},"properties":{"units_in_meter":100}})";
}

/// A square top of 20 cm, from 1 m up, and half a hood to be sewn on its upper edge.
/// @param turn   of the hood [degrees]; 90: it stands across the top
/// @param low    where it begins [cm]  @param label  of its upper edge; may be empty
/// @param height  of the hood [cm]
inline std::string half_hood(double turn, double low, const std::string& label, double height) {
  return R"({"pattern":{"panels":{"top":)" + panel_20_wide(100, "") + R"(,"hood":)" +
         panel_20_wide(low, label, turn, height) +
         R"(},"stitches":[[{"panel":"hood","edge":0},{"panel":"top","edge":2}]]},)" +
         R"("properties":{"units_in_meter":100}})";
}

/// A band, 20 by 6 cm, and 10 cm below it a flounce of another width [cm] and 15 cm height, to be
/// gathered on it.
inline std::string band_and_flounce(double width) {
  const auto panel = [](double wide, double high, double low) {
    const std::string w = std::to_string(wide), h = std::to_string(high);
    return R"({"vertices":[[0,0],[)" + w + ",0],[" + w + "," + h + "],[0," + h +
           R"(]],"edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},)" +
           R"({"endpoints":[3,0]}],"translation":[)" + std::to_string(-wide / 2) + "," +
           std::to_string(low) + R"(,0],"rotation":[0,0,0]})";
  };
  return R"({"pattern":{"panels":{"band":)" + panel(20, 6, 125) + R"(,"flounce":)" +
         panel(width, 15, 100) +
         R"(},"stitches":[[{"panel":"band","edge":0},{"panel":"flounce","edge":2}]]},)" +
         R"("properties":{"units_in_meter":100}})";
}

/// Trousers of four rectangles, 20 by 60 cm, 2 cm beside each other and 40 cm before each other;
/// the lower 40 cm of the inner sides are sewn to legs. Seams: inner and outer of the left leg,
/// inner and outer of the right one, front, back.
inline std::string trousers_pattern() {
  const auto panel = [](const char* name, const char* corners, int low, int before) {
    return '"' + std::string(name) + R"(":{"vertices":)" + corners +
           R"(,"edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},)"
           R"({"endpoints":[3,4]},{"endpoints":[4,0]}],"translation":[)" +
           std::to_string(low) + ",30," + std::to_string(before) + R"(],"rotation":[0,0,0]})";
  };
  const auto stitch = [](const char* one, int edge, const char* other, int other_edge) {
    return R"([{"panel":")" + std::string(one) + R"(","edge":)" + std::to_string(edge) +
           R"(},{"panel":")" + other + R"(","edge":)" + std::to_string(other_edge) + "}]";
  };
  return R"({"pattern":{"panels":{)" +
         panel("front_left", "[[0,0],[20,0],[20,60],[0,60],[0,40]]", 1, 20) + ',' +
         panel("back_left", "[[0,0],[0,40],[0,60],[20,60],[20,0]]", 1, -20) + ',' +
         panel("front_right", "[[0,0],[20,0],[20,40],[20,60],[0,60]]", -21, 20) + ',' +
         panel("back_right", "[[0,0],[0,60],[20,60],[20,40],[20,0]]", -21, -20) +
         R"(},"stitches":[)" + stitch("front_left", 4, "back_left", 0) + ',' +
         stitch("front_left", 1, "back_left", 3) + ',' + stitch("front_right", 1, "back_right", 3) +
         ',' + stitch("front_right", 4, "back_right", 0) + ',' +
         stitch("front_left", 3, "front_right", 2) + ',' + stitch("back_left", 1, "back_right", 2) +
         R"(]},"properties":{"units_in_meter":100}})";
}

/// Two rectangles in one plane that touch along the y axis, the right one 3 cm higher, to be sewn
/// together there.
inline std::string panels_side_by_side() {
  return R"({"pattern":{"panels":{
    "left":{"vertices":[[0,0],[20,0],[20,40],[0,40]],
      "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}],
      "translation":[-20,100,0],"rotation":[0,0,0]},
    "right":{"vertices":[[0,0],[20,0],[20,40],[0,40]],
      "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,0]}],
      "translation":[0,103,0],"rotation":[0,0,0]}},
    "stitches":[[{"panel":"left","edge":1},{"panel":"right","edge":3}]]},
    "properties":{"units_in_meter":100}})";
}

}  // namespace weft::test
