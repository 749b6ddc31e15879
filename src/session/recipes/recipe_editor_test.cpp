// SPDX-License-Identifier: Apache-2.0
#include "session/recipes/recipe_editor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <future>
#include <set>
#include <thread>

#include "pipeline/journal/journals.h"
#include "pipeline/journal/session_recipe.h"
#include "session/test_app.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class RecipeEditing : public testing::Test, protected TestApp {
 protected:
  void SetUp() override { begin(); }
  /// Presses Recipe..., answers, and waits.
  void change(std::function<bool(RecipeEditor&)> answer) {
    app_->dialogs.recipe = std::move(answer);
    press("file.recipe");
    document().settle();
  }
  /// Changes one number and uses the recipe.
  void use(const char* name, double to) {
    change([&](RecipeEditor& editor) {
      EXPECT_TRUE(editor.sections(name, false).front().source->set(name, to));
      return true;
    });
  }
};

TEST_F(RecipeEditing, ShowsWhatAUserSetsFirstAndFoldsTheExpertsParameters) {
  ChangeQueue queue;
  const RecipeEditor editor(queue, Recipe{});
  const auto sections = editor.sections("", false);
  ASSERT_GT(sections.size(), 5U);
  EXPECT_TRUE(sections.front().open);
  EXPECT_EQ(sections.front().names.size(), sections.front().notes.size()) << "each with its sentence";
  EXPECT_THAT(sections.front().names, testing::Contains("detect.false_alarm"));
  EXPECT_TRUE(std::none_of(sections.begin() + 1, sections.end(), [](const PanelSection& one) { return one.open; }));
  std::set<std::string> names;
  std::size_t count = 0;
  for (const PanelSection& section : sections) {
    names.insert(section.names.begin(), section.names.end());
    count += section.names.size();
  }
  EXPECT_EQ(names.size(), count) << "each once";
  EXPECT_EQ(count + 1, sections.front().source->properties().size()) << "all but whether to detect by itself";
}

TEST_F(RecipeEditing, FindsByWordsAndByWhatWasChanged) {
  ChangeQueue queue;
  RecipeEditor editor(queue, Recipe{});
  EXPECT_TRUE(editor.sections("", true).empty());
  EXPECT_TRUE(editor.sections("no such word", false).empty());
  const auto found = editor.sections("False Alarm", false);
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found.front().names, testing::Contains("detect.false_alarm"));
  ASSERT_TRUE(found.front().source->set("detect.false_alarm", 7.0));
  EXPECT_EQ(editor.changed(), 1U);
  ASSERT_EQ(editor.sections("", true).size(), 1U);
  editor.take_defaults();
  EXPECT_EQ(editor.changed(), 0U);
}

TEST_F(RecipeEditing, WhatDoesNotGoTogetherIsNeitherUsedNorSaved) {
  ChangeQueue queue;
  RecipeEditor editor(queue, Recipe{});
  ASSERT_TRUE(editor.sections("", false).front().source->set("median.kernel_fans", 4));
  ASSERT_FALSE(editor.problem());
  EXPECT_THAT(to_line(editor.problem().error()), HasSubstr("kernel 4 is not odd"));
  const auto file = TestSurvey::easy().fresh() / "r.json";
  EXPECT_FALSE(editor.save(file));
  EXPECT_FALSE(std::filesystem::exists(file));
}

// They stand together: each is told with what it is part of.
TEST_F(RecipeEditing, LabelsOfWhatAUserSetsAreUnique) {
  ChangeQueue queue;
  const RecipeEditor editor(queue, Recipe{});
  std::set<std::string> labels;
  for (const Property& one : editor.sections("", false).front().source->properties()) {
    if (!one.basic) continue;
    EXPECT_TRUE(labels.insert(one.label).second) << one.label;
  }
}

TEST_F(RecipeEditing, WhatIsSavedIsWhatARunReads) {
  ChangeQueue queue;
  RecipeEditor editor(queue, document().recipe());
  ASSERT_TRUE(editor.sections("", false).front().source->set("detect.false_alarm", 7.0));
  const auto file = TestSurvey::easy().fresh() / "r.json";
  ASSERT_TRUE(editor.save(file));
  const auto read = read_recipe(file.string());
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->automatic) << "a run detects by itself";
  EXPECT_EQ(recipe_text(*read),
            recipe_text(*recipe_from_text(R"({"recipe_version":1,"automatic":true,"detect":{"false_alarm":7}})")));
  editor.take_defaults();
  ASSERT_TRUE(editor.load(file));
  EXPECT_EQ(editor.changed(), 1U);
  const auto refused = editor.load("/nowhere.json");
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_line(refused.error()), HasSubstr("/nowhere.json"));
}

TEST_F(RecipeEditing, TheSurveyIsOpenedUnderItAndDecisionsStay) {
  paint(2, 4, 5, 5, 200);
  document().settle();
  document().look_at(3);
  document().settle();
  use("detect.tolerance_db", 7.0);
  EXPECT_EQ(document().recipe().detect.tolerance_db, 7.0);
  EXPECT_FALSE(document().recipe().automatic);
  EXPECT_EQ(document().ping(), 3) << "one goes on where one was";
  EXPECT_EQ(document().state().schools.size(), 1U);
  EXPECT_THAT(document().notices().back(), testing::EndsWith("in 1 parameter"));
  change([](RecipeEditor&) { return false; });
  EXPECT_EQ(document().recipe().detect.tolerance_db, 7.0) << "declined";
}

TEST_F(RecipeEditing, ItIsKeptForTheNextTimeAndForRunsOfTheSession) {
  paint(2, 4, 5, 5, 200);
  document().settle();
  use("detect.tolerance_db", 7.0);
  const auto folder = document().journal_path().parent_path();
  const auto session = read_session(folder);
  ASSERT_TRUE(session) << to_line(session.error());
  EXPECT_EQ(session->recipe_hash, recipe_hash(document().recipe()));
  begin();
  EXPECT_EQ(document().recipe().detect.tolerance_db, 7.0);
  std::filesystem::remove(folder / "session-recipe.json");
  begin();
  EXPECT_EQ(document().recipe().detect.tolerance_db, Recipe{}.detect.tolerance_db);
}

// As while the demo survey is simulated: what makes the files is not left half done.
TEST_F(RecipeEditing, WhatASurveyNeedsFirstIsDoneUnderTheNewRecipeToo) {
  ChangeQueue queue;
  Document document(queue, TestSurvey::options(TestSurvey::easy().fresh()));
  const auto folder = TestSurvey::easy().fresh() / "made";
  std::promise<void> begun;
  std::atomic<int> times = 0;
  document.open({folder}, [&](Work& work) -> Result<void> {
    if (++times == 1) {
      begun.set_value();
      while (!work.cancelled()) std::this_thread::yield();
      return fail(ErrorCode::cancelled, "stopped on request");
    }
    std::filesystem::copy(TestSurvey::easy().folder(), folder);
    return {};
  });
  begun.get_future().wait();
  Recipe recipe;
  recipe.detect.tolerance_db = 7.0;
  document.use_recipe(recipe);
  document.settle();
  EXPECT_EQ(times, 2);
  ASSERT_NE(document.survey(), nullptr) << document.notices().back();
  EXPECT_EQ(document.recipe().detect.tolerance_db, 7.0);
}

}  // namespace
}  // namespace sonar
