// SPDX-License-Identifier: Apache-2.0
// Surveys whose beams make no grid of fans: nothing of them can be looked at, and every view says why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/app_model.h"
#include "session/test_survey.h"

namespace sonar {
namespace {

class WithoutAGrid : public testing::Test {
 protected:
  void SetUp() override {
    synth::SurveyParams params = synth::survey_params(synth::Preset::easy);
    params.observations = 1;
    params.pings = 3;
    params.schools = 1;
    auto beams = synth::ms70_beams();
    beams.pop_back();  // 20 fans of 25 beams, but for one
    Work work;
    ASSERT_TRUE(synth::simulate_survey(folder_, params, beams, false, "test", work));
  }

  std::filesystem::path folder_ = TestSurvey::easy().fresh() / "raw";
  ChangeQueue queue_;
};

TEST_F(WithoutAGrid, EveryViewSaysWhyAndTheSurveyMapShowsItsTrack) {
  AppModel app(queue_, TestSurvey::options(TestSurvey::easy().fresh()));
  EXPECT_THAT(idle_text(app, "top_slice"), testing::HasSubstr("Open a survey"));
  LivePicture& map = *app.picture("survey_map");
  map.resize({480, 360}, 1.0);
  map.set_seen(true);
  Document& document = app.workspace.document;
  document.open({folder_});
  do {
    document.settle();
    map.wait();
  } while (queue_.drain() > 0);
  ASSERT_NE(document.survey(), nullptr);
  EXPECT_FALSE(document.shown());
  const std::string why = document.nothing_shown();
  EXPECT_THAT(why, testing::HasSubstr("obs-0001 cannot be shown"));
  EXPECT_THAT(why, testing::HasSubstr("499 beams, but 20 elevations x 25 azimuths"));
  ASSERT_FALSE(document.notices().empty());
  EXPECT_EQ(document.notices().back(), why);
  for (const PictureDock& dock : app.pictures) EXPECT_EQ(idle_text(app, dock.id), why) << dock.id;
  EXPECT_GT(map.image().size.width, 0) << map.problem();
  const auto asked = document.show(0);
  ASSERT_FALSE(asked);
  EXPECT_EQ(asked.error().text, why);
}

}  // namespace
}  // namespace sonar
