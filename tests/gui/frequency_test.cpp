// SPDX-License-Identifier: Apache-2.0
// Schools over the frequencies of the fans, and their curves, by key and mouse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>

#include "session/charts/curves_model.h"
#include "session/charts/frequency_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class FrequencyInTheWindow : public WindowAtWork {
 protected:
  FrequencyModel& chart() { return dynamic_cast<FrequencyModel&>(*app_->picture("frequency")); }
};

TEST_F(FrequencyInTheWindow, TheClickedSchoolStandsInAChartOverFrequency) {
  EXPECT_TRUE(dock("frequency")->isHidden());
  key(Qt::Key_3, Qt::AltModifier | Qt::ShiftModifier);
  ASSERT_FALSE(dock("frequency")->isHidden());
  EXPECT_FALSE(chart().sight());
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  raise("frequency");
  ASSERT_TRUE(chart().sight()) << chart().problem();
  EXPECT_EQ(chart().sight()->data.series.size(), 2U) << "the school and the water round it";
  keep_picture("frequency");
  auto* water = window_->findChild<QCheckBox*>("frequency.water");
  ASSERT_NE(water, nullptr);
  water->setChecked(false);
  settle();
  EXPECT_EQ(chart().sight()->data.series.size(), 1U);
  const PixelPoint at = chart().sight()->chart.places.front().at;
  move("frequency", at);
  EXPECT_THAT(chart().hint(at), testing::HasSubstr("kHz"));
  water->setChecked(true);
  key(Qt::Key_F9);
  keep_picture("frequency-dark");
  key(Qt::Key_Escape);
  EXPECT_FALSE(chart().sight()) << "nothing is selected";
  key(Qt::Key_3, Qt::AltModifier | Qt::ShiftModifier);
  EXPECT_TRUE(dock("frequency")->isHidden());
}

TEST_F(FrequencyInTheWindow, CurvesOfTheClickedSchoolStandBesideIt) {
  const auto curves = [this]() -> CurvesModel& { return dynamic_cast<CurvesModel&>(*app_->picture("curves")); };
  EXPECT_TRUE(dock("curves")->isHidden());
  key(Qt::Key_5, Qt::AltModifier | Qt::ShiftModifier);
  ASSERT_FALSE(dock("curves")->isHidden());
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  raise("curves");
  ASSERT_TRUE(curves().sight()) << curves().problem();
  EXPECT_EQ(curves().sight()->data.panels.size(), 1U);
  keep_picture("curves");
  auto* which = window_->findChild<QComboBox*>("curves.curve");
  ASSERT_NE(which, nullptr);
  which->setCurrentIndex(static_cast<int>(SchoolCurve::tolerance));
  settle();
  EXPECT_EQ(curves().problem(), "");
  EXPECT_EQ(curves().sight()->data.panels.size(), 3U);
  keep_picture("curves-tolerance");
  key(Qt::Key_5, Qt::AltModifier | Qt::ShiftModifier);
  EXPECT_TRUE(dock("curves")->isHidden());
}

}  // namespace
}  // namespace sonar
