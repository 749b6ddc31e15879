// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pipeline/commands/command.h"
#include "session/test_app.h"
#include "session/tools/growth.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class SchoolActs : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    paint(2, 6, 5, 5, 200, 4, 20);
    document().settle();
    select(1);
    document().look_at(4);
    document().settle();
  }
  void act(const std::string& id, const std::string& command, const std::string& undo) {
    press(id);
    document().settle();
    EXPECT_EQ(last_line().command, command) << id;
    EXPECT_EQ(document().choices().undo_text, undo) << id;
    EXPECT_EQ(document().choices().failure, "") << id;
  }
  [[nodiscard]] std::vector<std::int64_t> pings_of(std::int64_t number) {
    std::vector<std::int64_t> pings;
    for (const auto& school : document().state().schools) {
      if (school->number != number) continue;
      for (const auto& there : school->masks.pings) pings.push_back(there.ping_index);
    }
    return pings;
  }
  using Pings = std::vector<std::int64_t>;
};

TEST_F(SchoolActs, DeleteTakesTheSchoolAndUndoBringsItBack) {
  act("school.delete", "delete", "Undo delete school 1");
  EXPECT_TRUE(document().state().schools.empty());
  press("edit.undo");
  document().settle();
  EXPECT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ(document().choices().redo_text, "Redo delete school 1");
  EXPECT_EQ(app_->actions.find("edit.redo")->text_now(), "Redo delete school 1");
  press("edit.redo");
  document().settle();
  EXPECT_TRUE(document().state().schools.empty());
}

TEST_F(SchoolActs, PropagationFollowsTheControlPanel) {
  ASSERT_TRUE(workspace().select.set("tolerance_db", 7.0));
  const PropagateCommand command = propagation_as_set(workspace());
  EXPECT_EQ(command.tracked.tolerance_db, 7.0);
  EXPECT_EQ(command.grow.tolerance_db, 7.0);
  EXPECT_EQ(command.tracked.connectivity, workspace().select.values().connectivity);
  EXPECT_EQ(command.paper.connectivity, workspace().select.values().connectivity);
  press("school.propagate_forwards");
  document().settle();
  ASSERT_EQ(last_line().command, "propagate");
  const auto act = act_of(last_line());
  ASSERT_TRUE(act);
  const auto& done = std::get<PropagateCommand>(act->command);
  EXPECT_EQ(done.tracked.tolerance_db, 7.0);
  EXPECT_EQ(done.reach_backward, 0);
}

TEST_F(SchoolActs, ReshapingIsOfThePingOrOfTheWholeTrack) {
  act("school.fill_holes", "fill_holes", "Undo fill holes of school 1");
  EXPECT_FALSE(last_line().args->value("all_pings", true));
  act("school.smooth_all", "smooth", "Undo smooth school 1");
  EXPECT_TRUE(last_line().args->value("all_pings", false));
  act("school.smooth", "smooth", "Undo smooth school 1");
  act("school.largest_part", "largest_part", "Undo keep the largest part of school 1");
  act("school.largest_part_all", "largest_part", "Undo keep the largest part of school 1");
  act("school.fill_holes_all", "fill_holes", "Undo fill holes of school 1");
}

TEST_F(SchoolActs, SplitFromHereOnAndMergeAgain) {
  act("school.split", "split", "Undo split school 1");
  EXPECT_EQ(pings_of(1), (Pings{2, 3}));
  EXPECT_EQ(pings_of(2), (Pings{4, 5, 6}));
  press("school.merge");
  EXPECT_THAT(document().notices().back(), HasSubstr("part of school 1"));
  select(2);
  document().settle();
  EXPECT_EQ(last_line().command, "merge");
  EXPECT_EQ(document().choices().undo_text, "Undo merge into school 1");
  EXPECT_EQ(pings_of(1), (Pings{2, 3, 4, 5, 6}));
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
}

TEST_F(SchoolActs, EscapeGivesUpAMerge) {
  press("school.split");
  document().settle();
  press("school.merge");
  const auto selected = workspace().school();
  press("tool.cancel");
  EXPECT_EQ(workspace().school(), selected) << "the merge was waiting, not the selection";
  select(2);
  document().settle();
  EXPECT_EQ(last_line().command, "split");
  press("tool.cancel");
  EXPECT_EQ(workspace().school(), std::nullopt);
}

TEST_F(SchoolActs, ThePieceUnderTheCursorBecomesASchool) {
  BrushCommand far;
  far.runs = {{channel(15, 10), 400, 6}};
  far.school = selected_school(workspace())->key();
  document().act(4, far);
  document().settle();
  workspace().cursor.set(Voxel{15, 10, 402});
  act("school.split_piece", "split", "Undo split school 1");
  EXPECT_EQ(pings_of(2), (Pings{4}));
  EXPECT_EQ(pings_of(1), (Pings{2, 3, 4, 5, 6}));
}

TEST_F(SchoolActs, CommentsAndSpeciesAreAskedFor) {
  app_->dialogs.text = [](const auto&, const std::string& label, const std::string& now) {
    EXPECT_EQ(now, "");
    return label == "Comment" ? std::string("two\nlines") : std::string("herring");
  };
  act("school.comment", "comment", "Undo comment on school 1");
  EXPECT_EQ(document().state().schools.front()->masks.decided.comment, "two lines");
  act("school.species", "species", "Undo set species of school 1");
  EXPECT_EQ(document().state().schools.front()->masks.decided.species, "herring");
  app_->dialogs.text = [](const auto&, const auto&, const auto&) { return std::optional<std::string>(); };  // declined
  const auto lines = document().choices().lines->size();
  press("school.comment");
  document().settle();
  EXPECT_EQ(document().choices().lines->size(), lines);
}

TEST_F(SchoolActs, AnEmptyAnswerWipesACommentAndUndoBringsItBack) {
  app_->dialogs.text = [](const auto&, const auto&, const auto&) { return std::string("a wreck"); };
  act("school.comment", "comment", "Undo comment on school 1");
  app_->dialogs.text = [](const auto&, const auto&, const std::string& now) {
    EXPECT_EQ(now, "a wreck");
    return std::string();
  };
  act("school.comment", "comment", "Undo comment on school 1");
  EXPECT_EQ(document().state().schools.front()->masks.decided.comment, "");
  begin();
  EXPECT_EQ(document().state().schools.front()->masks.decided.comment, "");  // it stands in the journal
  press("edit.undo");
  document().settle();
  EXPECT_EQ(document().state().schools.front()->masks.decided.comment, "a wreck");
}

TEST_F(SchoolActs, ASchoolIsRenamedAndCalledSoEverywhere) {
  app_->dialogs.text = [](const auto&, const std::string& label, const std::string& now) {
    EXPECT_EQ(label, "Name");
    EXPECT_EQ(now, "");
    return std::string("north wall");
  };
  act("school.rename", "rename", "Undo rename school 1");
  EXPECT_EQ(title_of(document(), {0, 1}), "school 1 (north wall)");
  const ProductPtr product = document().product(0);
  ASSERT_TRUE(product);
  ASSERT_EQ(product->schools.size(), 1U);
  EXPECT_EQ(product->schools[0].name, "north wall") << "tables and files have it";
  act("school.smooth", "smooth", "Undo smooth school 1 (north wall)");
  press("edit.undo");
  press("edit.undo");
  document().settle();
  EXPECT_EQ(title_of(document(), {0, 1}), "school 1");
  press("edit.redo");
  document().settle();
  begin();
  EXPECT_EQ(title_of(document(), {0, 1}), "school 1 (north wall)");
}

TEST_F(SchoolActs, DecisionsAreWrittenDown) {
  app_->preferences.advance = false;
  act("review.accept", "decide", "Undo accept school 1");
  act("review.reject", "decide", "Undo reject school 1");
  act("review.species.2", "species", "Undo set species of school 1");
  EXPECT_EQ(document().state().schools.front()->masks.decided.species, "mackerel");
  act("review.species.0", "species", "Undo set species of school 1");
  EXPECT_EQ(document().state().schools.front()->masks.decided.species, "");
}

TEST_F(SchoolActs, ASchoolIsCarriedOnFromTheMaskInThisPingToTheSidesAskedFor) {
  const PingMask before = in_ping(document().state().schools.front()->masks, 3)->mask;
  workspace().select.assign([] {
    SelectParams params;
    params.reach_pings = 2;
    return params;
  }());
  act("school.propagate_forwards", "propagate", "Undo propagate school 1");
  const auto act_now = act_of(last_line());
  ASSERT_TRUE(act_now);
  const auto& command = std::get<PropagateCommand>(act_now->command);
  EXPECT_EQ(command.reach, 2);
  EXPECT_EQ(command.reach_backward, 0);
  EXPECT_TRUE(command.school.has_value());
  // The side that was not asked for stays as it was.
  ASSERT_NE(in_ping(document().state().schools.front()->masks, 3), nullptr);
  EXPECT_EQ(in_ping(document().state().schools.front()->masks, 3)->mask, before);
  act("school.propagate_backwards", "propagate", "Undo propagate school 1");
  EXPECT_EQ(std::get<PropagateCommand>(act_of(last_line())->command).reach_forward, 0);
  act("school.propagate", "propagate", "Undo propagate school 1");
  EXPECT_FALSE(std::get<PropagateCommand>(act_of(last_line())->command).reach_forward.has_value());
}

TEST_F(SchoolActs, NothingSelectedNothingDone) {
  press("school.none");
  const auto lines = document().choices().lines->size();
  for (const char* id : {"school.delete", "school.fill_holes", "school.split", "school.merge", "school.propagate",
                         "school.rename", "school.comment", "review.accept"}) {
    EXPECT_FALSE(app_->actions.find(id)->enabled()) << id;
    press(id);
  }
  document().settle();
  EXPECT_EQ(document().choices().lines->size(), lines);
}

TEST(SchoolSearch, IsRefusedWhileNothingIsOpen) {
  ChangeQueue queue;
  AppModel app(queue, {});
  app.actions.find("schools.detect")->run();
  ASSERT_EQ(app.workspace.document.notices().size(), 1U);
  EXPECT_THAT(app.workspace.document.notices().front(), HasSubstr("open a survey first"));
}

TEST_F(SchoolActs, SearchingTheSurveyFindsSchoolsInEveryObservation) {
  press("schools.detect_all");
  document().settle();
  EXPECT_TRUE(document().detected(0));
  EXPECT_TRUE(document().detected(1));
  EXPECT_FALSE(document().state(1).schools.empty());
  EXPECT_EQ(document().choices().undo_text, "Undo detect schools in 2 observations");
  EXPECT_EQ(pings_of(1), (Pings{2, 3, 4, 5, 6})) << "the school that was there keeps its number";
  // One step, however many observations: one key takes it back, one does it again, and both stand in the journal.
  const auto found = document().state(1).schools.size();
  press("edit.undo");
  document().settle();
  EXPECT_EQ(document().state(0).schools.size(), 1U);
  EXPECT_TRUE(document().state(1).schools.empty());
  EXPECT_EQ(document().choices().redo_text, "Redo detect schools in 2 observations");
  press("edit.redo");
  document().settle();
  EXPECT_EQ(document().state(1).schools.size(), found);
  begin();
  EXPECT_EQ(document().state(1).schools.size(), found);
  EXPECT_EQ(pings_of(1), (Pings{2, 3, 4, 5, 6}));
  press("edit.undo");
  document().settle();
  EXPECT_TRUE(document().state(1).schools.empty()) << "also after the next start";
}

}  // namespace
}  // namespace sonar
