// SPDX-License-Identifier: Apache-2.0
#include "school/track/steady_masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "school/detect/detect.h"
#include "school/test_ball.h"
#include "school/test_water.h"
#include "signal/test_data.h"

namespace sonar {
namespace {

constexpr double kTolerance_db = 10.0;
constexpr double kUnit_sv = 1e-7;

/// What a voxel returns beside a school's 1000, and what its mask then holds.
struct Sea {
  std::function<int(int ping, int row, int sample)> also = [](int, int, int) { return 0; };
  std::function<bool(int ping, int row, int sample)> hidden = [](int, int, int) { return false; };
  std::function<bool(int ping, int row)> faulty = [](int, int) { return false; };
  bool fading = false;
};

/// Pings of a ship that passes a school whose echo fades outwards: 10 dB below its core it is a ball.
struct Passage {
  explicit Passage(const Sea& sea = {}, int count = 7,
                   const test::Ball& ball = {{-200.0, 60.0, -100.0}, {0.4, 0.3, 0.0}, 25.0}) {
    const Geographic start{60.0, 4.0};
    for (int p = 0; p < count; ++p) {
      pings.push_back({p, p * 5 * kSecondNs, test::ship_at(p), {}});
      whole.push_back(test::ball_mask(ball, sector, pings.back().placement, start, p * test::kInterval_s));
      const Point<Sonar> core =
          PingFrame(pings.back().placement, start).from_world(ball.start + ball.velocity * (p * test::kInterval_s));
      pings.back().detections.push_back(sighting(sea, p, core, ball.radius_m));
      schools.front().pings.push_back({p, {0}, {}});
    }
  }
  Passage& steady() {
    steady_masks(schools, pings, sector, kTolerance_db);
    return *this;
  }
  [[nodiscard]] PingMask mask(std::size_t p) const { return mask_of(schools.front().pings[p], pings[p]); }

  Detection sighting(const Sea& sea, int p, const Point<Sonar>& core, double radius_m) {
    const PingMask& ball = whole.back();
    EchoPieces pieces;
    pieces.box = box_of(ball, 25).enlarged(2, 3, 40).clipped({20, 25, 900});
    pieces.box.first_sample -= pieces.box.first_sample % EchoPieces::kSamples;
    pieces.unit_sv = kUnit_sv;
    const Shape3 shape{pieces.box.fans(), pieces.box.beams(), pieces.piece(pieces.box.last_sample) + 1};
    pieces.own = Array3<std::int16_t>(shape);
    pieces.water = Array3<std::int16_t>(shape, 10);
    PingMask seen;
    for (int f = 0; f < shape.fans; ++f) {
      for (int b = 0; b < shape.beams; ++b) {
        for (int i = 0; i < shape.samples; ++i) {
          const int row = (pieces.box.first_fan + f) * 25 + pieces.box.first_beam + b;
          const int first = pieces.box.first_sample + i * EchoPieces::kSamples;
          const double off = norm(sector.centre(row / 25, row % 25, first + 1) - core) / radius_m;
          double echo = 1000.0 * std::pow(10.0, -off * off);
          echo = std::max<double>(echo, sea.also(p, row, first));
          if (sea.hidden(p, row, first)) echo *= 0.05;
          if (sea.fading) echo *= random.exponential();
          pieces.own(f, b, i) = static_cast<std::int16_t>(std::lround(std::min(echo, 32000.0)));
          if (sea.faulty(p, row)) pieces.own(f, b, i) = EchoPieces::kUnheard;
          if (echo < 100.0) continue;
          seen.runs.push_back({row, first, EchoPieces::kSamples});
          seen.confidence.insert(seen.confidence.end(), EchoPieces::kSamples, 255);
        }
      }
    }
    Detection detection = describe_mask(std::move(seen), flags.view(), sector);
    detection.pieces = std::move(pieces);
    return detection;
  }

  TestRandom random{5};
  Sector sector = test::grid().sector(test::range_axis());
  Array3<SampleFlags> flags{{20, 25, 900}};
  std::vector<PingMask> whole;
  std::vector<DetectedPing> pings;
  std::vector<SchoolTrack> schools{1};
};

/// In one ping alone, beside the ball: 7 dB fainter than it, so that the ping's own mask holds it.
const Sea kOnce{.also = [](int p, int row, int sample) {
  return p == 3 && row / 25 < 9 && row % 25 > 17 && sample >= 560 && sample < 600 ? 200 : 0;
}};

std::size_t beside(const PingMask& mask) {
  std::size_t voxels = 0;
  for (const Run& run : mask.runs) {
    if (run.row / 25 < 9 && run.row % 25 > 17) voxels += static_cast<std::size_t>(run.count);
  }
  return voxels;
}

TEST(SteadyMasks, WhatOnePingAloneHoldsGoes) {
  Passage passage(kOnce);
  const std::size_t before = beside(passage.mask(3));
  ASSERT_GT(before, 100U);
  EXPECT_LT(beside(passage.steady().mask(3)), before / 4);
}

TEST(SteadyMasks, WhatOnePingAloneMissesComesBack) {
  const Sea faded{.hidden = [](int p, int row, int) { return p == 3 && row / 25 >= 8; }};
  Passage passage(faded);
  const double before = dice(passage.mask(3), passage.whole[3]);
  ASSERT_LT(before, 0.75);
  EXPECT_GT(dice(passage.steady().mask(3), passage.whole[3]), 0.8);
}

// Lost packets in a quarter of the beams of one ping: they are members still, and flagged as faulty elsewhere.
TEST(SteadyMasks, WhatFaultsHideIsToldByTheOthers) {
  Passage passage({.faulty = [](int p, int row) { return p == 3 && row % 4 == 1; }});
  const PingMask mask = passage.steady().mask(3);
  EXPECT_GT(dice(mask, passage.whole[3]), 0.85);
  EXPECT_TRUE(std::ranges::any_of(mask.runs, [](const sonar::Run& run) { return run.row % 4 == 1; }));
}

// Rounding to voxels on the way to the other pings moves the border by some of the outermost ones at most.
TEST(SteadyMasks, TheSchoolStays) {
  Passage passage;
  passage.steady();
  for (std::size_t p = 0; p < passage.whole.size(); ++p) {
    EXPECT_GT(dice(passage.mask(p), passage.whole[p]), 0.9) << p;
  }
}

// Each piece alone has the whole fading of one look. Independent answer: the ball itself.
TEST(SteadyMasks, ManyLooksAreCloserToTheSchoolThanOne) {
  Passage passage({.fading = true});
  double before = 0.0;
  for (std::size_t p = 0; p < 7; ++p) before += dice(passage.mask(p), passage.whole[p]) / 7.0;
  passage.steady();
  double after = 0.0;
  for (std::size_t p = 0; p < 7; ++p) after += dice(passage.mask(p), passage.whole[p]) / 7.0;
  EXPECT_GT(after, before + 0.02);
  EXPECT_GT(after, 0.88);
}

TEST(SteadyMasks, AnotherSchoolsVoxelsStayItsOwn) {
  Passage passage;
  PingMask other;  // the upper half of the ball
  for (const sonar::Run& run : passage.whole[3].runs) {
    if (run.row / 25 >= 8) other.runs.push_back(run);
  }
  for (const sonar::Run& run : other.runs)
    other.confidence.insert(other.confidence.end(), static_cast<std::size_t>(run.count), 255);
  passage.pings[3].detections.push_back(describe_mask(other, passage.flags.view(), passage.sector));
  passage.schools.push_back({});
  passage.schools.back().pings.push_back({3, {1}, {}});
  passage.schools.front().pings[3].part = subtract(passage.whole[3], other);
  passage.steady();
  EXPECT_EQ(overlap(passage.mask(3), other), 0U);
  EXPECT_GT(passage.mask(3).voxels(), passage.whole[3].voxels() / 3);
}

TEST(SteadyMasks, WhatLayLongAgoTellsNothing) {
  Passage passage(kOnce);
  for (DetectedPing& ping : passage.pings) ping.time *= 12;
  const PingMask before = passage.mask(3);
  EXPECT_EQ(passage.steady().mask(3), before) << "a minute between pings";
}

}  // namespace
}  // namespace sonar
