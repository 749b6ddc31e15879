// SPDX-License-Identifier: Apache-2.0
#include "targets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace sonar::bench {
namespace {

template <class Compare>
bool holds(const Compare& compare) {
  Targets targets;
  compare(targets);
  return targets.hold();
}

TEST(Targets, TheProcessorBesideTheNaiveShader) {
  EXPECT_TRUE(holds([](Targets& t) { t.cpu_beside_naive(false, 12.0, 65.0, 64.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.cpu_beside_naive(false, 11.9, 70.0, 64.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.cpu_beside_naive(false, 20.0, 64.0, 64.0); })) << "fast and no better";
  EXPECT_TRUE(holds([](Targets& t) { t.cpu_beside_naive(true, 8.0, 54.0, 64.0); })) << "dense: 54 dB will do";
  EXPECT_FALSE(holds([](Targets& t) { t.cpu_beside_naive(true, 7.9, 60.0, 50.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.cpu_beside_naive(true, 9.0, 53.9, 50.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.cpu_beside_naive(false, std::nan(""), 70.0, 64.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.cpu_beside_naive(false, 20.0, std::nan(""), 64.0); }));
}

TEST(Targets, TheProcessorBesideVtk) {
  EXPECT_TRUE(holds([](Targets& t) { t.cpu_beside_vtk(false, 25.0, 60.0, 48.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.cpu_beside_vtk(false, 24.0, 60.0, 48.0); }));
  EXPECT_TRUE(holds([](Targets& t) { t.cpu_beside_vtk(true, 16.0, 54.0, 48.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.cpu_beside_vtk(true, 30.0, 48.0, 48.0); }));
}

TEST(Targets, OpenGlIsFourTimesAsFastInClearWaterAndNeverSlower) {
  EXPECT_TRUE(holds([](Targets& t) { t.gl_beside_naive(false, 4.0, 60.0, 52.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.gl_beside_naive(false, 3.9, 60.0, 52.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.gl_beside_naive(false, 7.0, 52.0, 52.7); })) << "fast and no better";
  EXPECT_TRUE(holds([](Targets& t) { t.gl_beside_naive(true, 1.0, 54.0, 64.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.gl_beside_naive(true, 0.99, 60.0, 50.0); }));
  EXPECT_FALSE(holds([](Targets& t) { t.gl_beside_naive(true, 3.0, 53.0, 50.0); }));
}

TEST(Targets, AFrameWhileDraggingTakes65Milliseconds) {
  EXPECT_TRUE(holds([](Targets& t) { t.dragging(0.065); }));
  EXPECT_FALSE(holds([](Targets& t) { t.dragging(0.066); }));
  EXPECT_FALSE(holds([](Targets& t) { t.dragging(std::nan("")); }));
}

TEST(Targets, WhatWasMeasuredIsSaidWhetherMetOrMissed) {
  Targets targets;
  targets.at_least("at rest, dB", 45.0, 45.0);
  EXPECT_TRUE(targets.hold());
  targets.at_least("at rest, dB", 45.0, 42.9);
  targets.at_most("a frame, ms", 65.0, 65.1);
  EXPECT_EQ(targets.news(), (std::vector<std::string>{"at rest, dB: target 45, measured 45: met",
                                                      "at rest, dB: target 45, measured 42.9: MISSED",
                                                      "a frame, ms: target 65 at most, measured 65.1: MISSED"}));
  EXPECT_EQ(targets.verdict()[0], "FAILED: 2 of 3 checks, see above");
}

TEST(Targets, WhatIsSetBesideATargetNeverFails) {
  Targets targets;
  targets.beside("half resolution, ms wall (at most)", 65.0, 3700.0);
  EXPECT_TRUE(targets.hold());
  const auto news = targets.news();
  ASSERT_EQ(news.size(), 1U);
  EXPECT_NE(news[0].find("target 65, measured 3700"), std::string::npos) << news[0];
  EXPECT_TRUE(targets.news().empty());
}

TEST(Targets, WhatWasNotComparedIsSaidWithItsReason) {
  Targets targets;
  targets.at_least("a ratio", 1.0, 2.0);
  targets.skip("VTK on closeup haze", "no vtk.csv");
  EXPECT_TRUE(targets.hold());
  const auto verdict = targets.verdict();
  ASSERT_EQ(verdict.size(), 3U);
  EXPECT_EQ(verdict[0], "all 1 checks passed");
  EXPECT_EQ(verdict[1], "1 comparisons were not made:");
  EXPECT_EQ(verdict[2], "  VTK on closeup haze: no vtk.csv");
  targets.require(false, "a thing");
  EXPECT_EQ(targets.verdict()[0], "FAILED: 1 of 2 checks, see above");
}

}  // namespace
}  // namespace sonar::bench
