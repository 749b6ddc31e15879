// SPDX-License-Identifier: Apache-2.0
#include "session/recipe_preview.h"

#include <gtest/gtest.h>

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
