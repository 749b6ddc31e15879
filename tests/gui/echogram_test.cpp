// SPDX-License-Identifier: Apache-2.0
// The echogram by mouse: going to a ping, the linked cursor, zooming.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/echograms/echogram_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class EchogramDock : public WindowAtWork {
 protected:
  static constexpr const char* kDock = "echogram";
  EchogramModel& echogram() { return dynamic_cast<EchogramModel&>(*app_->picture(kDock)); }
  /// Where a ping shows a sample of the beam that the echogram is of.
  PixelPoint place_of(std::int64_t ping, int sample) {
    const OpenObservation& shown = *document().shown();
    const EchogramPlot& plot = echogram().places()->above;
    const EchogramRow row = echogram_rows(shown.sector(), shown.placement(ping), plot.of.name.of).front();
    const TimeNs time = shown.files().navigation[static_cast<std::size_t>(ping)].time;
    return {plot.places.x_of(time) + 2.0, plot.places.plot.at(0.0, row.height_m(sample)).y};
  }
};

TEST_F(EchogramDock, AClickGoesToItsPingAndTheSlicesShowWhatIsPointedAt) {
  raise(kDock);
  workspace().slices.set({8, 10});
  settle();
  ASSERT_TRUE(echogram().places());
  click(kDock, place_of(6, 500));
  EXPECT_EQ(document().ping(), 6);
  move(kDock, place_of(6, 500));
  ASSERT_TRUE(workspace().cursor());
  EXPECT_EQ(workspace().cursor()->fan, 8);
  EXPECT_EQ(workspace().cursor()->beam, 10);
  // A pixel of a dock is some samples high.
  EXPECT_NEAR(workspace().cursor()->sample, 500, 12);
  EXPECT_FALSE(app_->picture("top_slice")->overlays().empty());
  move(kDock, place_of(3, 500));
  EXPECT_FALSE(workspace().cursor()) << "another ping";
}

TEST_F(EchogramDock, ItIsSwitchedToTheFanAndToDepth) {
  raise(kDock);
  settle();
  const Image before = echogram().image();
  for (const char* act : {"echogram.fan", "echogram.depth"}) app_->actions.find(act)->run();
  settle();
  EXPECT_EQ(echogram().problem(), "");
  EXPECT_NE(echogram().image(), before);
  EXPECT_EQ(echogram().places()->above.places.plot.y.label, "depth (m)");
}

}  // namespace
}  // namespace sonar
