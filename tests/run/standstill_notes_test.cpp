#include "weft/run/standstill_notes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "weft/run.h"

namespace weft {
namespace {

/// Of 100 points and frames of 1/50 s.
RunReport report_of(std::vector<FrameReport> frames) {
  RunReport report;
  report.particles = 100;
  report.substeps = 4;
  report.time_step = 1.0 / 200;
  report.history = std::move(frames);
  report.notes = {"before"};
  return report;
}

FrameReport fallen(int points) {
  FrameReport frame;
  frame.fell_back = points;
  return frame;
}

FrameReport late(double seconds) {
  FrameReport frame;
  frame.lost_time = seconds;
  return frame;
}

TEST(StandstillNotes, ALittleIsNotNoted) {
  for (RunReport report : {report_of({}), report_of({fallen(1), late(0.0002)})}) {
    note_what_stood_still(report);
    EXPECT_EQ(report.notes.size(), 1);
  }
}

TEST(StandstillNotes, TellOfTheFirstFrameInWhichManyPointsFellBack) {
  RunReport report = report_of({fallen(0), fallen(7), fallen(50)});
  note_what_stood_still(report);
  ASSERT_EQ(report.notes.size(), 2);
  EXPECT_EQ(report.notes[0].find("frame 2: 7 of 100 points were put back"), 0) << report.notes[0];
}

TEST(StandstillNotes, TellOfTheFrameThatLostMostTime) {
  RunReport report = report_of({late(0.001), late(0), late(0.005)});
  note_what_stood_still(report);
  ASSERT_EQ(report.notes.size(), 2);
  EXPECT_EQ(report.notes[0].find("frame 3: cloth stood still for 25 %"), 0) << report.notes[0];
}

TEST(StandstillNotes, JsonAddsUpWhatAllFramesLost) {
  const auto json = nlohmann::json::parse(to_json(report_of({late(0.25), late(0.5)})));
  EXPECT_EQ(json.at("lost_time"), 0.75);
}

}  // namespace
}  // namespace weft
