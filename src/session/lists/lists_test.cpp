// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>

#include "session/lists/cells.h"
#include "session/lists/school_ping_table.h"
#include "session/test_app.h"

namespace sonar {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Lists : public testing::Test, protected TestApp {
 protected:
  void SetUp() override { begin(); }
  [[nodiscard]] Rows& rows(const std::string& id) { return *app_->rows(id); }
  /// Text of a cell by its column's title.
  [[nodiscard]] std::string text(const std::string& id, std::size_t row, const std::string& title) {
    const auto& columns = rows(id).columns();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (columns[c].title == title) return rows(id).cell(row, c).text;
    }
    return "no column " + title;
  }
};

TEST(Cells, AFigureShowsItsErrorWhereItIsKnown) {
  const Cell depth = with_error(number_cell(63.24, 1), 1.36);
  EXPECT_EQ(depth.text, "63.2 \u00B1 1.4");
  EXPECT_EQ(depth.brief, "63.2") << "where the list is narrow";
  EXPECT_EQ(std::get<double>(depth.key), 63.24) << "sorted by the figure";
  EXPECT_EQ(with_error(number_cell(63.24, 1), kUnknown).text, "63.2");
  EXPECT_EQ(with_error(number_cell(kUnknown, 1), 1.36).text, "");
}

TEST_F(Lists, TheSurveyTreeHasObservationsWithTheirFilesBelowAndOpensThem) {
  Rows& tree = rows("survey_tree");
  std::vector<std::size_t> top;
  for (std::size_t row = 0; row < tree.rows(); ++row) {
    if (tree.level(row) == 0) top.push_back(row);
  }
  ASSERT_EQ(top.size(), 2U);
  EXPECT_EQ(text("survey_tree", top[0], "Survey"), "obs-0001");
  EXPECT_EQ(text("survey_tree", top[0], "Pings"), std::to_string(TestSurvey::kPings));
  EXPECT_THAT(text("survey_tree", top[0], "Time"), HasSubstr(" \u2013 "));
  EXPECT_LT(tree.cell(top[0], 1).brief.size(), text("survey_tree", top[0], "Time").size());
  EXPECT_THAT(text("survey_tree", top[0] + 1, "Survey"), HasSubstr(".raw"));
  EXPECT_EQ(tree.level(top[0] + 1), 1);
  EXPECT_EQ(tree.selected(), top[0]);
  tree.open(top[1] + 1);
  EXPECT_EQ(document().shown()->index(), 1U);
  EXPECT_EQ(tree.selected(), top[1]);
}

// While the files are read the list has what their ends tell, and opens a part.
TEST(ListsWhileReading, TheSurveyTreeTellsRunsOfFilesAndOpensOneAlone) {
  ChangeQueue queue;
  AppModel app(queue, TestSurvey::options(TestSurvey::easy().fresh()));
  Document& document = app.workspace.document;
  Rows& tree = *app.rows("survey_tree");
  std::vector<std::string> names;
  std::string hint;
  const Listening heard_of(document.changes(), [&](DocumentChange change) {
    if (change != DocumentChange::glance || !document.glance() || document.glance()->files.size() < 2) return;
    for (std::size_t row = 0; row < tree.rows(); ++row) names.push_back(tree.cell(row, 0).text);
    hint = tree.cell(0, 4).text;
    EXPECT_TRUE(tree.for_now());
    tree.open(1);
  });
  document.open({TestSurvey::easy().folder()});
  document.settle();
  ASSERT_EQ(names.size(), 2U);
  EXPECT_THAT(names[0], HasSubstr("SYNTHETIC-D"));
  EXPECT_EQ(hint, "not read yet; a double-click opens its file alone");
  EXPECT_FALSE(tree.for_now());
  EXPECT_EQ(document.survey()->files.size(), 1U);
  EXPECT_EQ(tree.cell(0, 0).text, "obs-0001");
}

// The simulated sonar's table is a published MS70's: by its own figures psi is 0.4 to 6.7 dB beyond the widths, most in the
// deepest fan.
TEST_F(Lists, TheSurveyTreeTellsBeamAnglesFanByFan) {
  const Rows& tree = rows("survey_tree");
  std::size_t row = 0;
  while (row < tree.rows() && text("survey_tree", row, "Survey") != "20 fans \u00D7 25 beams") ++row;
  ASSERT_LT(row + 20, tree.rows());
  EXPECT_EQ(tree.level(row), 1);
  EXPECT_THAT(text("survey_tree", row, "Remarks"), HasSubstr("more than the widths give"));
  EXPECT_THAT(text("survey_tree", row, "Remarks"), HasSubstr("of 500 beams"));
  EXPECT_THAT(text("survey_tree", row + 1, "Survey"), HasSubstr("fan 0, -45.0"));
  EXPECT_THAT(text("survey_tree", row + 1, "Remarks"), HasSubstr("in 25 of 25 beams no transmit beam explains it"));
  EXPECT_THAT(text("survey_tree", row + 20, "Survey"), HasSubstr("fan 19, "));
  EXPECT_EQ(tree.level(row + 20), 2);
}

TEST_F(Lists, SchoolsAreThereAtOnceAndMeasuredSoonAfter) {
  paint(2, 4, 5, 5, 200);
  document().settle();
  ASSERT_EQ(rows("schools").rows(), 1U);
  EXPECT_EQ(text("schools", 0, "School"), "1");
  EXPECT_EQ(text("schools", 0, "Observation"), "obs-0001");
  EXPECT_EQ(text("schools", 0, "Pings"), "3");
  EXPECT_EQ(text("schools", 0, "Status"), "unreviewed");
  const ProductPtr product = document().product(0);
  ASSERT_TRUE(product);
  EXPECT_EQ(text("schools", 0, "Depth"), fmt::format("{:.1f}", product->schools.front().depth_m));
  EXPECT_THAT(text("schools", 0, "Latitude"), HasSubstr("\u2032 N"));

  workspace().school.set(std::nullopt);
  EXPECT_EQ(rows("school_pings").rows(), 0U);
  rows("schools").select(0);
  document().settle();
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
  EXPECT_EQ(document().ping(), 3);
  EXPECT_EQ(workspace().slices(), (SlicePlaces{6, 6, 203}));
  ASSERT_EQ(rows("school_pings").rows(), 3U);
  EXPECT_EQ(rows("school_pings").selected(), 1U);
  rows("school_pings").select(2);
  document().settle();
  EXPECT_EQ(document().ping(), 4);
}

TEST_F(Lists, PingsOfAllSchoolsAreListedOnDemand) {
  paint(2, 3, 5, 5, 200);
  paint(2, 2, 10, 10, 300);
  document().settle();
  workspace().school.set(std::nullopt);
  press("list.pings_of_all");
  EXPECT_EQ(rows("school_pings").rows(), 3U);
  press("list.pings_of_all");
  EXPECT_EQ(rows("school_pings").rows(), 0U);
}

TEST_F(Lists, TheJournalTellsEveryActTheNewestFirstAndMarksTheUndone) {
  paint(2, 2, 5, 5, 200);
  paint(5, 5, 5, 5, 200);
  document().undo();
  document().settle();
  Rows& journal = rows("journal");
  ASSERT_EQ(journal.rows(), 3U);
  EXPECT_EQ(text("journal", 0, "What"), "undo line 2");
  EXPECT_EQ(text("journal", 1, "What"), "brush school 2");
  EXPECT_EQ(text("journal", 1, "Undone"), "undone");
  EXPECT_TRUE(journal.faded(1));
  EXPECT_EQ(text("journal", 2, "What"), "brush school 1");
  EXPECT_EQ(text("journal", 2, "On"), "obs-0001 ping 2");
  EXPECT_EQ(text("journal", 2, "Operator"), "tester");
  EXPECT_EQ(text("journal", 2, "Undone"), "");
  journal.open(2);
  EXPECT_EQ(document().ping(), 2);
}

TEST_F(Lists, WhatWasToldStandsAmongTheDiagnostics) {
  document().tell("the first");
  document().tell("the last");
  EXPECT_EQ(text("diagnostics", 0, "What"), "the last");
  EXPECT_EQ(text("diagnostics", 1, "What"), "the first");
  for (std::size_t row = 0; row < rows("diagnostics").rows(); ++row) {
    EXPECT_FALSE(text("diagnostics", row, "Kind").empty());
  }
}

// What is detected anew at an opening is there before it is measured: nothing is said to be lost meanwhile.
TEST_F(Lists, WhileSchoolsAreFoundAgainNoDecisionIsCalledLost) {
  press("schools.detect_all");
  document().settle();
  ASSERT_GT(rows("schools").rows(), 0U);
  rows("schools").select(0);
  document().settle();
  press("review.accept");
  document().settle();
  app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
  std::optional<Listening> listening(std::in_place, document().changes(), [&](DocumentChange change) {
    if (change != DocumentChange::state && change != DocumentChange::measures) return;
    if (document().survey() == nullptr || !document().choices().states.contains(0)) return;
    for (std::size_t row = 0; row < rows("diagnostics").rows(); ++row) {
      EXPECT_NE(text("diagnostics", row, "Kind"), "decision-lost") << text("diagnostics", row, "What");
    }
  });
  document().open({TestSurvey::easy().folder()});
  while (!document().staged()) queue_.drain();  // the search begins with the first picture
  document().cancel();
  document().settle();
  ASSERT_TRUE(document().product(0)) << "measured without the schools";
  press("schools.detect_all");
  document().settle();
  listening.reset();
  EXPECT_EQ(text("schools", 0, "Status"), "accepted");
  const std::string named = "accept school " + text("schools", 0, "School");
  EXPECT_EQ(text("journal", 0, "What"), named) << "by the school that it is about, which was not there at first";
  EXPECT_EQ(document().choices().undo_text, "Undo " + named);
}

TEST_F(Lists, ChoicesOfEarlierRunsAreSeenInTheWholeSurvey) {
  ASSERT_TRUE(document().show(1));
  document().settle();
  paint(2, 2, 5, 5, 200);
  document().undo();
  document().redo();
  paint(3, 3, 5, 5, 200);
  document().undo();
  document().settle();
  begin();  // a new run: it shows the first observation with schools
  EXPECT_EQ(document().shown()->index(), 1U);
  ASSERT_EQ(rows("schools").rows(), 1U);
  EXPECT_EQ(text("schools", 0, "Observation"), "obs-0002");
  // What was undone in the earlier run can be done again, and says so.
  EXPECT_THAT(document().choices().redo_text, HasSubstr("Redo brush"));
  press("edit.redo");
  document().settle();
  EXPECT_EQ(rows("schools").rows(), 2U);
}

TEST_F(Lists, NoTwoActionsHaveOneKey) { EXPECT_THAT(app_->actions.clashes(), IsEmpty()); }

}  // namespace
}  // namespace sonar
