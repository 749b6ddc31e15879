// SPDX-License-Identifier: Apache-2.0
#include "session/charts/frequency_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "session/test_app.h"

namespace sonar {
namespace {

class SchoolsOverFrequency : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    chart().resize({700, 450}, 1.0);
    chart().set_seen(true);
    settle();
  }
  FrequencyModel& chart() { return dynamic_cast<FrequencyModel&>(*app_->picture("frequency")); }
  void settle() {
    do {
      document().settle();
      chart().wait();
    } while (queue_.drain() > 0);
  }
  /// Schools of the first observation, and which of them is seen in most pings.
  void find() {
    (void)longest_found();
    settle();
    const auto& schools = document().state().schools;
    const auto longest = std::max_element(schools.begin(), schools.end(), [](const auto& a, const auto& b) {
      return a->masks.pings.size() < b->masks.pings.size();
    });
    ASSERT_NE(longest, schools.end());
    longest_ = (*longest)->number;
    for (const auto& in_ping : (*longest)->masks.pings) pings_.push_back(in_ping.ping_index);
  }
  /// The series of a school or of its water.
  const FrequencySeries* series(bool water, std::size_t which = 0) {
    if (!chart().sight()) return nullptr;
    for (const FrequencySeries& one : chart().sight()->data.series) {
      if (one.muted == water && which-- == 0) return &one;
    }
    return nullptr;
  }

  std::int64_t longest_ = 0;
  std::vector<std::int64_t> pings_;  ///< in which that is seen
};

TEST_F(SchoolsOverFrequency, NeedASchoolThatIsSelected) {
  EXPECT_FALSE(chart().sight());
  EXPECT_THAT(idle_text(*app_, "frequency"), testing::HasSubstr("Select a school"));
  find();
  select(longest_);
  settle();
  ASSERT_TRUE(chart().sight()) << chart().problem();
  workspace().school.set(std::nullopt);
  settle();
  EXPECT_FALSE(chart().sight());
}

// The simulated fish echo alike at all frequencies: over all of its pings a school's line is level. What is left is that
// fans cut it at places of another density, that beams smear its edges, and speckle: a few dB, however the mean is made.
TEST_F(SchoolsOverFrequency, OfFishThatEchoAlikeAreALevelLineFarAboveTheWater) {
  find();
  select(longest_);
  settle();
  const FrequencySeries* school = series(false);
  const FrequencySeries* water = series(true);
  ASSERT_TRUE(school != nullptr && water != nullptr) << chart().problem();
  // Fans that a tenth of the school's samples lie in, so that chance is small.
  std::int64_t samples = 0;
  for (const FrequencyPoint& point : school->points) samples += point.samples;
  double least = 1e9;
  double most = -1e9;
  std::size_t fans = 0;
  for (const FrequencyPoint& point : school->points) {
    EXPECT_GE(point.frequency_khz, 75.0 - 1.0);
    EXPECT_LE(point.frequency_khz, 112.0 + 1.0);
    if (10 * point.samples < samples) continue;
    ++fans;
    least = std::min(least, point.sv_db);
    most = std::max(most, point.sv_db);
  }
  EXPECT_GE(fans, 2U);
  EXPECT_LT(most - least, 4.0);
  for (const FrequencyPoint& point : water->points) {
    if (!std::isfinite(point.sv_db)) continue;
    EXPECT_LT(point.sv_db, least - 6.0) << point.fan;
  }
}

TEST_F(SchoolsOverFrequency, SeveralAreComparedAndOnePingIsLookedAtAlone) {
  find();
  std::set<SchoolName> all;
  for (const auto& school : document().state().schools) all.insert({0, school->number});
  ASSERT_GE(all.size(), 2U);
  workspace().school.set(SchoolName{0, longest_});
  workspace().chosen_schools.set(all);
  settle();
  ASSERT_TRUE(chart().sight()) << chart().problem();
  EXPECT_NE(series(false, all.size() - 1), nullptr);
  EXPECT_EQ(series(false, all.size()), nullptr);
  workspace().chosen_schools.set({});
  settle();
  // In a fan that the school always lies in there are as many pings as it has masks.
  const auto most_pings = [&] {
    std::int64_t most = 0;
    for (const FrequencyPoint& point : series(false)->points) most = std::max(most, point.pings);
    return most;
  };
  EXPECT_EQ(most_pings(), static_cast<std::int64_t>(pings_.size()));
  ASSERT_TRUE(workspace().picture_file.set("frequency.one_ping", true));
  document().look_at(pings_[pings_.size() / 2]);
  settle();
  ASSERT_NE(series(false), nullptr) << chart().problem();
  EXPECT_EQ(most_pings(), 1);
  ASSERT_TRUE(workspace().picture_file.set("frequency.water", false));
  settle();
  EXPECT_EQ(series(true), nullptr);
}

TEST_F(SchoolsOverFrequency, TellWhatAPointRestsOnAndFollowWhatIsDone) {
  find();
  select(longest_);
  settle();
  ASSERT_TRUE(chart().sight()) << chart().problem();
  const auto place = chart().sight()->chart.places.back();
  EXPECT_THAT(chart().hint(place.at), testing::HasSubstr("kHz"));
  EXPECT_EQ(chart().hint({1.0, 1.0}), "");
  press("school.delete");
  settle();
  EXPECT_FALSE(chart().sight()) << "what is not there has no chart";
}

}  // namespace
}  // namespace sonar
