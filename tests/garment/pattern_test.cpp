#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/patterns.h"
#include "weft/error.h"
#include "weft/garment.h"
#include "weft/garment/edge_curve.h"

namespace weft {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

std::string tube() { return test::tube_pattern(40, 30, 20, 100); }

/// The first edge of the panel `back`, which is 30 cm long, with a curvature.
double length_with(const std::string& curvature) {
  const std::string text = replaced(tube(), R"({"endpoints":[0,1]})",
                                    R"({"endpoints":[0,1],"curvature":)" + curvature + "}");
  const Pattern pattern = parse_pattern(text, "p");
  return length_of(edge_polyline(pattern.panels[0], pattern.panels[0].edges[0]));
}

TEST(PatternFile, GivesPanelsInMetres) {
  const Pattern pattern = parse_pattern(tube(), "p");
  ASSERT_EQ(pattern.panels.size(), 2U);
  EXPECT_EQ(pattern.panels[0].name, "back");
  EXPECT_EQ(pattern.stitches.size(), 2U);
  EXPECT_NEAR(pattern.panels[1].vertices[2].x, 0.4, 1e-12);
  EXPECT_NEAR(pattern.panels[1].placed({0.4, 0.3}).y, 1.3, 1e-12);
  EXPECT_NEAR(pattern.panels[1].placed({0.4, 0.3}).z, 0.1, 1e-12);
}

TEST(PatternFile, LeavesOutEdgesShorterThanAnyThread) {
  // Generators write edges of hundredths of a millimetre; samples along them would be next to one
  // point.
  const Pattern pattern = parse_pattern(
      R"({"pattern":{"panels":{"p":{"vertices":[[0,0],[40,0],[40,0.004],[40,30],[0,30]],
          "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},
                   {"endpoints":[4,0]}],"translation":[0,0,0],"rotation":[0,0,0]}},
          "stitches":[[{"panel":"p","edge":2},{"panel":"p","edge":4}]]},
          "properties":{"units_in_meter":100}})",
      "p");
  ASSERT_EQ(pattern.panels[0].edges.size(), 4U);
  EXPECT_EQ(pattern.notes.size(), 1U);
  ASSERT_EQ(pattern.stitches.size(), 1U);
  EXPECT_EQ(pattern.stitches[0].a.edge, 1);
  EXPECT_EQ(pattern.stitches[0].b.edge, 3);
}

TEST(PatternFile, SaysWhichStitchesGoWithEdgesThatAreLeftOut) {
  // The third edge of the panel, 2 mm long, is sewn to one of 30 cm, which then stays open.
  const Pattern pattern = parse_pattern(
      R"({"pattern":{"panels":{"p":{"vertices":[[0,0],[40,0],[40,30],[39.8,30],[0,30]],
          "edges":[{"endpoints":[0,1]},{"endpoints":[1,2]},{"endpoints":[2,3]},{"endpoints":[3,4]},
                   {"endpoints":[4,0]}]}},
          "stitches":[[{"panel":"p","edge":2},{"panel":"p","edge":4}]]}})",
      "p");
  EXPECT_TRUE(pattern.stitches.empty());
  ASSERT_EQ(pattern.notes.size(), 2U);
  EXPECT_EQ(pattern.notes[0], "panel 'p', edge 2: left out with its stitch, it is 2 mm long");
  EXPECT_EQ(pattern.notes[1], "1 of 1 panels sewn to nothing and held by no label, the first 'p'");
}

TEST(PatternFile, NotesCirclesThatDoNotReachFromEndToEnd) {
  const auto notes_with = [](const std::string& radius) {
    return parse_pattern(replaced(tube(), R"({"endpoints":[0,1]})",
                                  R"({"endpoints":[0,1],"curvature":{"type":"circle","params":[)" +
                                      radius + ",0,0]}}"),
                         "p")
        .notes;
  };
  EXPECT_TRUE(notes_with("14.9999").empty());  // rounding
  const std::vector<std::string> notes = notes_with("12");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("panel 'back', edge 0: a half circle of radius 150 mm"),
            std::string::npos)
      << notes[0];
}

TEST(PatternFile, NotesKeysThatNothingReads) {
  const std::string curved =
      replaced(tube(), R"({"endpoints":[0,1]})",
               R"({"endpoints":[0,1],"curvatur":{"type":"circle","params":[30,0,0]}})");
  const std::vector<std::string> notes =
      parse_pattern(replaced(curved, R"("translation")", R"("translate":[0,0,0],"translation")"),
                    "p")
          .notes;
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find(R"(': key "translate" is not known)"), std::string::npos) << notes[0];
  EXPECT_NE(notes[1].find(R"(', edge 0: key "curvatur" is not known)"), std::string::npos)
      << notes[1];
}

TEST(PatternFile, TurnsPanelsAboutXThenYThenZ) {
  PatternPanel panel;
  panel.rotate = {90, 90, 0};
  const Vec3d p = panel.placed({0, 1});  // about x to +z, about y from there to +x
  EXPECT_NEAR(p.x, 1, 1e-12);
  EXPECT_NEAR(p.y, 0, 1e-12);
  EXPECT_NEAR(p.z, 0, 1e-12);
}

TEST(PatternFile, CurvesHaveTheirLengths) {
  EXPECT_NEAR(length_with("null"), 0.3, 1e-12);
  EXPECT_NEAR(length_with(R"({"type":"circle","params":[15,0,0]})"), 0.15 * std::numbers::pi, 1e-5);
  // Of a parabola over a chord c with its top at height h: by its closed form.
  const double c = 0.3, h = 0.03, s = std::sqrt(c * c + 16 * h * h);
  const double arc = s / 2 + c * c / (8 * h) * std::log((4 * h + s) / c);
  EXPECT_NEAR(length_with(R"({"type":"quadratic","params":[[0.5,0.2]]})"), arc, 1e-5);
  EXPECT_NEAR(length_with("[0.5,0.2]"), arc, 1e-5);
  // The same parabola as a cubic.
  EXPECT_NEAR(
      length_with(R"({"type":"cubic","params":[[0.33333333,0.13333333],[0.66666667,0.13333333]]})"),
      arc, 1e-5);
}

TEST(PatternFile, ControlPointsMayBeInThePanelsAxes) {
  const auto control = [](const std::string& coordinates, const std::string& at) {
    std::string file =
        replaced(tube(), "{\"endpoints\":[0,1]}", "{\"endpoints\":[0,1],\"curvature\":" + at + "}");
    file = replaced(file, "\"units_in_meter\":100",
                    "\"units_in_meter\":100,\"curvature_coords\":\"" + coordinates + "\"");
    return parse_pattern(file, "p.json").panels[0].edges[0].curve.controls.front();
  };
  // The edge goes up from 0 to 30 cm.
  const Vec2d relative = control("relative", "[0.5,0.1]"),
              absolute = control("absolute", "[-3,15]");
  EXPECT_NEAR(relative.x, -0.03, 1e-12);
  EXPECT_NEAR(relative.y, 0.15, 1e-12);
  EXPECT_NEAR(absolute.x, -0.03, 1e-12);
  EXPECT_NEAR(absolute.y, 0.15, 1e-12);
}

TEST(PatternFile, ArcsGoTheWayTheySay) {
  const auto middle = [](int large, int counterclockwise) {
    PatternPanel panel;
    panel.vertices = {{0, 0}, {1, 0}};
    PatternEdge edge{0, 1, {PatternCurve::Kind::arc, {}, 1, large != 0, counterclockwise != 0}, ""};
    const std::vector<Vec2d> line = edge_polyline(panel, edge);
    return line[line.size() / 2].y;
  };
  const double low = 1 - std::sqrt(0.75), high = 1 + std::sqrt(0.75);
  EXPECT_NEAR(middle(0, 1), -low, 1e-9);
  EXPECT_NEAR(middle(0, 0), low, 1e-9);
  EXPECT_NEAR(middle(1, 1), -high, 1e-9);
  EXPECT_NEAR(middle(1, 0), high, 1e-9);
}

struct Broken {
  const char *what, *by, *said;
};

class BrokenPatterns : public testing::TestWithParam<Broken> {};

TEST_P(BrokenPatterns, AreRefusedInOneLineThatNamesThePlace) {
  const Broken& broken = GetParam();
  try {
    parse_pattern(replaced(tube(), broken.what, broken.by), "p.json");
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(broken.said), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(PatternFile, WithOneSideOnlyIsRefused) {
  // The sides of one panel sewn with a twist, and one turned stitch of the two between a pair.
  const std::string band =
      replaced(test::band_pattern(60, 20, 100, 30), R"("edge":3}])", R"("edge":3},"right_wrong"])");
  const std::string pair = replaced(tube(), R"({"panel":"back","edge":2}])",
                                    R"({"panel":"back","edge":2},"right_wrong"])");
  for (const auto& [text, place] :
       {std::pair(band, "panel 'band', edge 1"), std::pair(pair, "panel 'back', edge 0")})
    try {
      parse_pattern(text, "p.json");
      ADD_FAILURE() << "not refused";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("leaves one side only"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BrokenPatterns,
    testing::Values(
        Broken{"{\"pattern\"", "{\"pattern", "p.json"},
        Broken{"\"pattern\"", "\"other\"", "no 'pattern'"},
        Broken{"\"panels\"", "\"panel\"", "no 'panels'"},
        Broken{"{\"endpoints\":[3,0]}", "{\"endpoints\":[3,1]}",
               "panel 'back', edge 3: an end at vertex 1"},
        Broken{"{\"endpoints\":[0,1]}", "{\"endpoints\":[0,9]}", "panel 'back': edge 0"},
        Broken{"{\"endpoints\":[0,1]}", "{\"endpoints\":[0]}", "edge 0"},
        Broken{"[[0,0],[0,30.000000],[40.000000,30.000000],[40.000000,0]]",
               "[[0,0],[40,30],[0,30],[40,0]]", "crosses itself"},
        Broken{"[[0,0],[0,30.000000],[40.000000,30.000000],[40.000000,0]]",
               "[[0,0],[0,30],[0,60],[0,20]]", "without area"},
        Broken{"[[0,0],[0,30.000000]", "[[0,0],[0,\"a\"]", "no number"},
        Broken{"[[0,0],[0,30.000000]", "[[0,0],[0,1e300]", "panel 'back'"},
        Broken{"{\"panel\":\"front\",\"edge\":1}", "{\"panel\":\"front\",\"edge\":7}",
               "panel 'front', edge"},
        Broken{"{\"panel\":\"front\",\"edge\":1}", "{\"panel\":\"none\",\"edge\":1}",
               "panel 'none'"},
        Broken{"{\"panel\":\"front\",\"edge\":1}", "{\"panel\":\"back\",\"edge\":2}",
               "a stitch with itself"},
        Broken{"{\"panel\":\"front\",\"edge\":3}", "{\"panel\":\"front\",\"edge\":1}",
               "two stitches"},
        Broken{"{\"panel\":\"front\",\"edge\":1}", "7", "stitch 0"},
        Broken{"\"edge\":2}]", "\"edge\":2},\"wrong\"]", "right_wrong"},
        Broken{"\"units_in_meter\":100", "\"units_in_meter\":0", "units_in_meter"},
        Broken{"\"units_in_meter\":100", "\"units_in_meter\":0.001", "units_in_meter"},
        Broken{"\"units_in_meter\":100", "\"units_in_meter\":1", "units_in_meter"},
        Broken{"\"units_in_meter\":100", "\"units_in_meter\":100000", "units_in_meter"},
        Broken{
            "{\"endpoints\":[0,1]}",
            "{\"endpoints\":[0,1],\"curvature\":{\"type\":\"quadratic\",\"params\":[[0.5,5e3]]}}",
            "panel 'back': edge 0: curvature: a control point"},
        Broken{"\"units_in_meter\":100", "\"units_in_meter\":100,\"curvature_coords\":\"polar\"",
               "curvature_coords: 'polar'"},
        Broken{"[[0,0],[40.000000,0],[40.000000,30.000000],[0,30.000000]]",
               "[[0,0],[40.000000,0],[40.000000,130.000000],[0,30.000000]]",
               "panel 'front', edge 1: 130 cm sewn to 30 cm"},
        Broken{"\"translation\":[", "\"translation\":[1e9,0,0],\"was\":[", "translation: a panel"},
        Broken{"{\"endpoints\":[0,1]}",
               "{\"endpoints\":[0,1],\"curvature\":{\"type\":\"spiral\",\"params\":[]}}",
               "'spiral'"},
        Broken{"{\"endpoints\":[0,1]}",
               "{\"endpoints\":[0,1],\"curvature\":{\"type\":\"circle\",\"params\":[-1,0,0]}}",
               "radius"}));

}  // namespace
}  // namespace weft
