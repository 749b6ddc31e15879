// SPDX-License-Identifier: Apache-2.0
// What the status line offers, taken by mouse: detection, and two schools that may be one.
#include <gtest/gtest.h>

#include <QPushButton>
#include <algorithm>
#include <vector>

#include "window_at_work.h"

namespace sonar {
namespace {

class Offers : public WindowAtWork {
 protected:
  QPushButton& button(const char* name) { return *window_->findChild<QPushButton*>(name); }
  void take(const char* name) { click_on(&button(name), {0.5 * button(name).width(), 0.5 * button(name).height()}); }
  /// The most confident voxel.
  Voxel brightest(const PingMask& mask) {
    auto left = std::max_element(mask.confidence.begin(), mask.confidence.end()) - mask.confidence.begin();
    const int beams = document().shown()->sector().beams();
    for (const sonar::Run& run : mask.runs) {
      if (left < run.count) return {run.row / beams, run.row % beams, run.first_sample + static_cast<int>(left)};
      left -= run.count;
    }
    return {};
  }
};

TEST_F(Offers, ASurveyWithoutSchoolsIsSearchedAtAClickAndFirstSeenAtItsStrongest) {
  ASSERT_EQ(document().ping(), 0);
  ASSERT_TRUE(button("detect").isVisible());
  take("detect");
  ASSERT_FALSE(document().state().schools.empty());
  EXPECT_FALSE(button("detect").isVisible());
  const auto school = workspace().school();
  ASSERT_TRUE(school);
  const ProductPtr product = document().product(school->observation);
  ASSERT_NE(product, nullptr);
  // No ping in which no edge cuts the school scatters more than the one on show.
  double here = 0.0;
  double most = 0.0;
  for (const SchoolPingRow& row : product->school_pings) {
    const bool on_show = row.school_id == school->number && row.ping_index == document().ping();
    if (on_show) here = row.backscatter_m2;
    if (on_show || row.touches_edge == 0) most = std::max(most, row.backscatter_m2);
  }
  EXPECT_GT(here, 0.0);
  EXPECT_EQ(here, most);
  // Whoever opens it again sees the same, and nothing is offered.
  const std::int64_t ping = document().ping();
  close();
  open();
  EXPECT_EQ(workspace().school(), school);
  EXPECT_EQ(document().ping(), ping);
  EXPECT_FALSE(button("detect").isVisible());
}

TEST_F(Offers, TwoSchoolsThatMayBeOneAreMergedAtAClickAndPartedByUndo) {
  key(Qt::Key_D);
  std::vector<SchoolMasks::InPing> longest;
  for (const auto& school : document().state().schools) {
    if (school->masks.pings.size() > longest.size()) longest = school->masks.pings;
  }
  ASSERT_GE(longest.size(), 6U);
  key(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(document().state().schools.empty());
  ASSERT_TRUE(workspace().select.set("reach_pings", 1));
  EXPECT_FALSE(button("merge").isVisible());
  // Followed by one ping on either side each, the second begins where the first ends.
  for (const std::size_t at : {1U, 4U}) {
    const Voxel voxel = brightest(longest[at].mask);
    key(Qt::Key_Escape);
    document().look_at(longest[at].ping_index);
    workspace().slices.set({voxel.fan, voxel.beam, voxel.sample});
    settle();
    double_click("top_slice", place_in("top_slice", voxel));
  }
  ASSERT_EQ(document().state().schools.size(), 2U);
  ASSERT_TRUE(button("merge").isVisible());
  EXPECT_EQ(button("merge").text().toStdString(), "Merge school 1 and school 2");
  keep_picture("merge-offered");
  take("merge");
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(masks().size(), 6U);
  EXPECT_FALSE(button("merge").isVisible());
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(document().state().schools.size(), 2U);
  EXPECT_TRUE(button("merge").isVisible()) << "they may still be one";
  key(Qt::Key_J, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_FALSE(button("merge").isVisible()) << "declined";
  EXPECT_EQ(document().state().schools.size(), 2U);
}

}  // namespace
}  // namespace sonar
