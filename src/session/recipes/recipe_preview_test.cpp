// SPDX-License-Identifier: Apache-2.0
#include "session/recipes/recipe_preview.h"

#include <gmock/gmock.h>

#include "base/number_text.h"
#include "session/test_app.h"

namespace sonar {
namespace {

class RecipePreviews : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    for (RecipePreview* one : {&both_->in_force, &both_->edited}) {
      one->resize({400, 300}, 1.0);
      one->set_seen(true);
    }
    settle();
  }
  void begin() {
    TestApp::begin();
    editor_ = std::make_unique<RecipeEditor>(queue_, document().recipe());
    both_ = std::make_unique<RecipeComparison>(workspace(), *editor_);
  }
  void TearDown() override { both_.reset(); }
  void settle() {
    do {
      document().settle();
      both_->in_force.wait();
      both_->edited.wait();
    } while (queue_.drain() > 0);
  }
  void set(const char* name, const PropertyValue& to) {
    ASSERT_TRUE(editor_->sections(name, false).front().source->set(name, to));
    settle();
  }
  /// Slices through the first school that the first ping has under the recipe in force.
  /// out  how many it has
  std::size_t cut_a_school() {
    Work work(1);
    const OpenObservation& shown = *document().shown();
    const auto ready = PingBeforeDetection::of(shown.survey(), shown.files(), document().recipe(), 0, work);
    EXPECT_TRUE(ready);
    const auto schools = (*ready)->schools(document().recipe().detect);
    EXPECT_FALSE(schools.empty());
    const auto& run = schools.front().mask.runs.front();
    const int beams = shown.sector().beams();
    workspace().slices.set({run.row / beams, run.row % beams, run.first_sample});
    settle();
    return schools.size();
  }

  std::unique_ptr<RecipeEditor> editor_;
  std::unique_ptr<RecipeComparison> both_;
};

TEST_F(RecipePreviews, ShowTheSameUntilSomethingIsEdited) {
  ASSERT_GT(both_->in_force.image().size.width, 0) << both_->in_force.problem();
  EXPECT_EQ(both_->edited.image(), both_->in_force.image());
  const Image before = both_->in_force.image();
  const Recipe begun = editor_->recipe();
  set("flags.near_field.range_m", begun.flags.near_field.range_m + 40.0);
  EXPECT_NE(both_->edited.image(), before) << "more of the near field is out";
  EXPECT_EQ(both_->in_force.image(), before) << "the recipe in force stays";
  set("flags.near_field.range_m", begun.flags.near_field.range_m);
  EXPECT_EQ(both_->edited.image(), before);
  set("median.enabled", false);
  EXPECT_NE(both_->edited.image(), before) << "unfiltered";
}

TEST_F(RecipePreviews, ShowTheSchoolsThatDetectionFindsUnderEach) {
  const std::string both_find = count_of(cut_a_school(), "school") + " in this ping, ";
  EXPECT_THAT(both_->in_force.schools_text(), testing::StartsWith(both_find));
  EXPECT_EQ(both_->edited.schools_text(), both_->in_force.schools_text());
  const Image with_schools = both_->edited.image();
  set("detect.min_beams", 1000);
  EXPECT_EQ(both_->edited.schools_text(), "no school in this ping") << "none is so wide";
  EXPECT_NE(both_->edited.image(), with_schools) << "no outline is left; Sv is the same";
  EXPECT_THAT(both_->in_force.schools_text(), testing::StartsWith(both_find));
  EXPECT_EQ(both_->in_force.image(), with_schools);
  set("detect.min_beams", 2);
  EXPECT_EQ(both_->edited.image(), with_schools);
  DisplayParams off = workspace().display.values();
  off.masks = false;
  workspace().display.assign(off);
  settle();
  EXPECT_NE(both_->in_force.image(), with_schools) << "outlines are switched off, as in the slices";
  EXPECT_THAT(both_->in_force.schools_text(), testing::StartsWith(both_find));
}

TEST_F(RecipePreviews, ALaterEditGivesUpWhatDetectionWasAt) {
  auto& source = *editor_->sections("detect.tolerance_db", false).front().source;
  for (const double tolerance_db : {3.0, 4.0, 5.0, 6.0}) ASSERT_TRUE(source.set("detect.tolerance_db", tolerance_db));
  settle();
  const std::string last = both_->edited.schools_text();
  set("detect.tolerance_db", 12.0);
  EXPECT_NE(both_->edited.schools_text(), last);
  set("detect.tolerance_db", 6.0);
  EXPECT_EQ(both_->edited.schools_text(), last) << "the picture on show is of the last edit";
}

TEST_F(RecipePreviews, SayWhyARecipeCannotBeUsed) {
  set("median.kernel_fans", 2);
  ASSERT_FALSE(editor_->problem()) << "an even number has no middle";
  EXPECT_EQ(both_->edited.problem(), to_line(editor_->problem().error()));
}

TEST_F(RecipePreviews, FollowThePing) {
  const Image before = both_->edited.image();
  document().look_at(5);
  settle();
  EXPECT_NE(both_->edited.image(), before);
  EXPECT_EQ(both_->edited.image(), both_->in_force.image());
}

}  // namespace
}  // namespace sonar
