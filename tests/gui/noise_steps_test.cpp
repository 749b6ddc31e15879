// SPDX-License-Identifier: Apache-2.0
// The noise steps by key and mouse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <algorithm>

#include "session/noise/noise_steps_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

using Shows = SliceStepPlace::Shows;

class NoiseStepsInTheWindow : public WindowAtWork {
 protected:
  NoiseStepsModel& panel() { return dynamic_cast<NoiseStepsModel&>(*app_->picture("noise_steps")); }
  PixelPoint middle_of(Shows shows, NoiseStep step) {
    const auto& places = panel().sight()->picture.places;
    const auto place = std::find_if(places.begin(), places.end(), [&](const SliceStepPlace& one) {
      return one.shows == shows && one.step == static_cast<std::size_t>(step);
    });
    EXPECT_NE(place, places.end());
    const PixelRect& r = place->plot;
    return {(r.x + 0.5 * r.width) / panel().scale(), (r.y + 0.5 * r.height) / panel().scale()};
  }
  bool compares(NoiseStep before, NoiseStep after) {
    bool left = false;
    bool right = false;
    for (const SliceStepPlace& one : panel().sight()->picture.places) {
      left = left || (one.shows == Shows::before && one.step == static_cast<std::size_t>(before));
      right = right || (one.shows == Shows::after && one.step == static_cast<std::size_t>(after));
    }
    return left && right;
  }
};

TEST_F(NoiseStepsInTheWindow, AreOffUntilTheyAreAskedForAndComparedByAClick) {
  (void)look_at_school();
  EXPECT_TRUE(dock("noise_steps")->isHidden());
  EXPECT_EQ(panel().pictures(), 0) << "off: nothing is computed";
  key(Qt::Key_2, Qt::AltModifier | Qt::ShiftModifier);
  ASSERT_FALSE(dock("noise_steps")->isHidden());
  ASSERT_TRUE(panel().seen());
  ASSERT_TRUE(panel().sight()) << panel().problem();
  keep_picture("noise-steps");
  dock("noise_steps")->setFloating(true);
  dock("noise_steps")->resize(1500, 900);
  settle();
  dock("noise_steps")->setFloating(false);
  settle();
  raise("noise_steps");
  click("noise_steps", middle_of(Shows::step, NoiseStep::median));
  EXPECT_TRUE(compares(NoiseStep::impulse_noise, NoiseStep::median));
  keep_picture("noise-steps-compared");
  click("noise_steps", middle_of(Shows::step, NoiseStep::unfiltered), Qt::ShiftModifier);
  EXPECT_TRUE(compares(NoiseStep::unfiltered, NoiseStep::median));
  key(Qt::Key_F9);
  keep_picture("noise-steps-dark");
  click("noise_steps", middle_of(Shows::difference, NoiseStep::median));
  EXPECT_FALSE(panel().comparing()) << "a click on a compared picture shows all again";
  keep_picture("noise-steps-dark-all");
  key(Qt::Key_2, Qt::AltModifier | Qt::ShiftModifier);
  EXPECT_TRUE(dock("noise_steps")->isHidden());
}

TEST_F(NoiseStepsInTheWindow, FollowTheSliceThatWasClickedAndTheControls) {
  const Target target = look_at_school();
  key(Qt::Key_2, Qt::AltModifier | Qt::ShiftModifier);
  const auto kind = [&] { return kind_of(panel().sight()->picture.map->view().slice); };
  EXPECT_EQ(kind(), SliceKind::top);
  key(Qt::Key_2, Qt::AltModifier | Qt::ShiftModifier);  // it stands in front of the slice from the side
  raise("side_slice");
  click("side_slice", place_in("side_slice", target.voxel));
  key(Qt::Key_2, Qt::AltModifier | Qt::ShiftModifier);
  EXPECT_EQ(kind(), SliceKind::side);
  auto* slice = window_->findChild<QComboBox*>("noise-steps.slice");
  ASSERT_NE(slice, nullptr);
  slice->setCurrentIndex(1);
  settle();
  EXPECT_EQ(kind(), SliceKind::top);
  const std::int64_t ping = document().ping();
  key(Qt::Key_Right);
  EXPECT_EQ(panel().sight()->steps->ping().ping_index, ping + 1);
}

}  // namespace
}  // namespace sonar
