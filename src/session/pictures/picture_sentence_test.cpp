// SPDX-License-Identifier: Apache-2.0
#include "session/pictures/picture_sentence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/slices/slice_places.h"
#include "session/test_app.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class PictureSentence : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    for (PictureDock& dock : app_->pictures) {
      dock.picture->resize({480, 360}, 1.0);
      dock.picture->set_seen(true);
    }
    settle();
  }
  void settle() {
    do {
      document().settle();
      for (PictureDock& dock : app_->pictures) dock.picture->wait();
    } while (queue_.drain() > 0);
  }
  [[nodiscard]] std::string of(const char* dock) { return picture_sentence(*app_, dock); }
};

TEST_F(PictureSentence, OfASliceSaysWhereItLiesAndWhatIsInThePing) {
  paint(4, 6, 5, 5, 200);
  document().look_at(5);
  lay_slices_through(workspace(), {5, 6, 200});
  settle();
  EXPECT_THAT(of("top_slice"), HasSubstr("Slice of fan 5, obs-0001, ping 5 of "));
  EXPECT_THAT(of("top_slice"), HasSubstr(", 1 school"));
  EXPECT_THAT(of("side_slice"), HasSubstr("Slice of beam 6, "));
  EXPECT_THAT(of("volume"), HasSubstr("Volume, obs-0001, ping 5"));
  select(document().state().schools.at(0)->number);
  EXPECT_THAT(of("top_slice"), HasSubstr("school 1 is selected."));
  document().look_at(7);
  settle();
  EXPECT_THAT(of("top_slice"), HasSubstr(", 0 schools"));
}

TEST_F(PictureSentence, OfAPlaneFollowsThePlane) {
  for (const auto& [lies, words] : {std::pair(PlaneSlice::Kind::horizontal, "Horizontal slice at "),
                                    std::pair(PlaneSlice::Kind::vertical, "Vertical slice along "),
                                    std::pair(PlaneSlice::Kind::oblique, "Oblique slice along ")}) {
    choose_plane(workspace(), lies);
    settle();
    EXPECT_THAT(of("plane_slice"), testing::StartsWith(words));
  }
}

TEST_F(PictureSentence, EveryPictureHasOne) {
  for (const PictureDock& dock : app_->pictures) {
    const std::string sentence = of(dock.id.c_str());
    EXPECT_GT(sentence.size(), 10U) << dock.id;
    const bool shown = !dock.picture->image().pixels.empty();
    EXPECT_TRUE(!shown || sentence.ends_with(".")) << dock.id << ": " << sentence;
  }
  EXPECT_EQ(of("no such dock"), "");
}

}  // namespace
}  // namespace sonar
