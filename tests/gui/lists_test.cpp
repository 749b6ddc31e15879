// SPDX-License-Identifier: Apache-2.0
// Lists by mouse and keys: order, filter, jump, copy.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QClipboard>
#include <QHeaderView>
#include <QImage>
#include <QLineEdit>
#include <QTreeView>
#include <algorithm>

#include "gui/action_menus.h"
#include "gui/rows_view.h"
#include "session/review/review.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class Lists : public WindowAtWork {
 protected:
  QTreeView& list(const std::string& id) { return *view(id)->findChild<QTreeView*>("rows"); }
  QLineEdit& filter(const std::string& id) { return *view(id)->findChild<QLineEdit*>("filter"); }
  Rows& rows(const std::string& id) { return *app_->rows(id); }
  std::size_t column(const std::string& id, const std::string& title) {
    const auto& all = rows(id).columns();
    const auto found = std::find_if(all.begin(), all.end(), [&](const ListColumn& c) { return c.title == title; });
    EXPECT_NE(found, all.end()) << title;
    return static_cast<std::size_t>(found - all.begin());
  }
  /// A click on a column's title; the list is scrolled to it first.
  void click_title(const std::string& id, std::size_t at) {
    QHeaderView& header = *list(id).header();
    list(id).scrollTo(list(id).model()->index(0, static_cast<int>(at)));
    settle();
    const int x = header.sectionViewportPosition(static_cast<int>(at)) + 12;
    click_on(header.viewport(), {static_cast<double>(x), 0.5 * header.height()});
  }
  void click_row(const std::string& id, int row, Qt::KeyboardModifiers keys = {}) {
    const QRect place = list(id).visualRect(list(id).model()->index(row, list(id).columnAt(8)));
    click_on(list(id).viewport(), {12.0, static_cast<double>(place.center().y())}, keys);
  }
  /// What a column shows, from the top down.
  std::vector<std::string> shown(const std::string& id, std::size_t at) {
    const auto& model = *list(id).model();
    std::vector<std::string> texts;
    for (int row = 0; row < model.rowCount(); ++row) {
      texts.push_back(model.index(row, static_cast<int>(at)).data().toString().toStdString());
    }
    return texts;
  }
  std::size_t with_status(const std::string& status) {
    std::size_t count = 0;
    for (const SurveySchool& school : survey_schools(document())) count += school.decided().status == status ? 1U : 0U;
    return count;
  }
  /// Two schools of an observation each, made by hands.
  void make_schools() {
    key(Qt::Key_D, Qt::ControlModifier);
    raise("schools");
    ASSERT_GE(rows("schools").rows(), 3U);
  }
};

TEST_F(Lists, AClickOnATitleSortsAndASecondTurnsTheOrder) {
  make_schools();
  const std::size_t depth = column("schools", "Depth");
  std::vector<std::pair<double, std::string>> known;
  for (std::size_t row = 0; row < rows("schools").rows(); ++row) {
    const Cell cell = rows("schools").cell(row, depth);
    ASSERT_TRUE(std::holds_alternative<double>(cell.key)) << "measured";
    known.emplace_back(std::get<double>(cell.key), cell.text);
  }
  std::sort(known.begin(), known.end());
  std::vector<std::string> rising;
  for (const auto& [key, text] : known) rising.push_back(text);
  click_title("schools", depth);
  EXPECT_EQ(shown("schools", depth), rising);
  click_title("schools", depth);
  std::reverse(rising.begin(), rising.end());
  EXPECT_EQ(shown("schools", depth), rising);
}

TEST_F(Lists, TheFilterLeavesWhatMatchesAndEnterDecidesNothing) {
  make_schools();
  const std::size_t all = rows("schools").rows();
  click_row("schools", 0);
  ASSERT_TRUE(workspace().school());
  const std::size_t lines = document().choices().lines->size();
  QLineEdit& line = filter("schools");
  click_on(&line, {20.0, 0.5 * line.height()});
  type("obs-0002");
  const auto names = shown("schools", column("schools", "Observation"));
  EXPECT_LT(names.size(), all);
  EXPECT_THAT(names, testing::Each("obs-0002"));
  EXPECT_EQ(document().choices().lines->size(), lines) << "digits and letters are no keys of the window";
  key(Qt::Key_Return);
  EXPECT_EQ(document().choices().lines->size(), lines) << "Enter in the line accepts no school";
  EXPECT_EQ(line.text(), "obs-0002");
  line.clear();
  settle();
  EXPECT_EQ(shown("schools", 0).size(), all);
}

TEST_F(Lists, AClickOnARowGoesToItsSchool) {
  make_schools();
  for (std::size_t row = 0; row < 3; ++row) {
    click_row("schools", static_cast<int>(row));
    ASSERT_TRUE(workspace().school());
    EXPECT_EQ(std::to_string(workspace().school()->number), shown("schools", column("schools", "School")).at(row));
    EXPECT_EQ(document().shown()->name(), shown("schools", column("schools", "Observation")).at(row));
    const auto selected = workspace().selected();
    ASSERT_TRUE(selected);
    EXPECT_NE(in_ping(document().state().schools[*selected]->masks, document().ping()), nullptr)
        << "a ping in which the school is";
  }
}

TEST_F(Lists, CtrlCCopiesRowsForASpreadsheet) {
  make_schools();
  const std::size_t depth = column("schools", "Depth");
  click_title("schools", depth);
  click_row("schools", 0);
  click_row("schools", 2, Qt::ControlModifier);
  key(Qt::Key_C, Qt::ControlModifier);
  const QStringList lines = QApplication::clipboard()->text().split('\n', Qt::SkipEmptyParts);
  ASSERT_EQ(lines.size(), 3) << "titles and two rows";
  const auto columns = static_cast<qsizetype>(rows("schools").columns().size());
  for (const QString& line : lines) EXPECT_EQ(line.split('\t').size(), columns);
  EXPECT_EQ(lines[0].split('\t')[static_cast<qsizetype>(depth)], "Depth [m]");
  EXPECT_EQ(lines[1].split('\t')[static_cast<qsizetype>(depth)].toStdString(), shown("schools", depth).at(0));
  EXPECT_EQ(lines[2].split('\t')[static_cast<qsizetype>(depth)].toStdString(), shown("schools", depth).at(2));
  key(Qt::Key_A, Qt::ControlModifier);
  key(Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(QApplication::clipboard()->text().split('\n', Qt::SkipEmptyParts).size(),
            static_cast<qsizetype>(rows("schools").rows()) + 1);
}

TEST_F(Lists, ADoubleClickInTheTreeOpensAnObservation) {
  const QRect place = list("survey_tree").visualRect(list("survey_tree").model()->index(1, 0));
  QTest::mouseDClick(window_->windowHandle(), Qt::LeftButton, {},
                     list("survey_tree").viewport()->mapTo(window_.get(), place.center()));
  settle();
  EXPECT_EQ(document().shown()->name(), "obs-0002");
}

TEST_F(Lists, InANarrowDockSentencesEndWhereTheListEnds) {
  app_->workspace.document.tell("a sentence that is much longer than the dock in which the diagnostics stand is wide");
  window_->resize(1366, 768);
  settle();
  raise("diagnostics");
  for (const char* id : {"diagnostics", "journal"}) {
    raise(id);
    key(Qt::Key_D);  // something to be listed
    const QHeaderView& header = *list(id).header();
    const auto what = static_cast<int>(column(id, "What"));
    const int end = header.sectionViewportPosition(what) + header.sectionSize(what);
    EXPECT_LE(end, list(id).viewport()->width()) << id;
    EXPECT_EQ(list(id).textElideMode(), Qt::ElideRight);
    const QModelIndex cell = list(id).model()->index(0, what);
    EXPECT_EQ(cell.data(Qt::ToolTipRole), cell.data()) << "all of it under the pointer";
  }
}

TEST_F(Lists, TheTreeShowsTimePingsAndSchoolsWithoutBeingMoved) {
  for (const QSize size : {QSize(1366, 768), QSize(1600, 1000), QSize(1920, 1200)}) {
    window_->resize(size);
    app_->actions.find("view.reset_layout")->run();
    key(Qt::Key_D);
    const QHeaderView& header = *list("survey_tree").header();
    const auto schools = static_cast<int>(column("survey_tree", "Schools"));
    EXPECT_LE(header.sectionViewportPosition(schools) + header.sectionSize(schools),
              list("survey_tree").viewport()->width())
        << size.width();
    const QModelIndex time = list("survey_tree").model()->index(0, static_cast<int>(column("survey_tree", "Time")));
    EXPECT_LE(list("survey_tree").sizeHintForIndex(time).width(), header.sectionSize(time.column()));
    EXPECT_GT(time.data(Qt::ToolTipRole).toString().size(), time.data().toString().size()) << "year and seconds";
  }
}

/// A list of one figure, which is told in one unit or in another.
class Told : public Rows {
 public:
  Told() { tell("m", "1.5", "1.5 \u00B1 0.1"); }
  [[nodiscard]] const std::vector<ListColumn>& columns() const override { return titles_; }
  [[nodiscard]] std::size_t rows() const override { return 3; }
  [[nodiscard]] Cell cell(std::size_t /*row*/, std::size_t column) const override {
    return column == 0 ? cell_ : Cell{"a word", std::string("a word")};
  }
  void tell(const std::string& unit, const std::string& brief, const std::string& text) {
    titles_[0].unit = unit;
    cell_ = {text, 1.5, brief};
    changed().tell();
  }

 private:
  std::vector<ListColumn> titles_{{"D", "m", "", true}, {"Word", "", ""}, {"Last", "", ""}};
  Cell cell_;
};

int cells_px(const QTreeView& list) { return static_cast<const QAbstractItemView&>(list).sizeHintForColumn(0); }

TEST(ListColumns, AreFittedAnewInAnotherUnitButNotWhereAHandGaveAWidth) {
  Told rows;
  RowsView view(rows, false);
  view.resize(400, 200);
  view.show();
  auto& list = *view.findChild<QTreeView*>("rows");
  const int before = list.columnWidth(0);
  EXPECT_GE(before, cells_px(list));
  rows.tell("m", "1234567890123.5", "");
  EXPECT_EQ(list.columnWidth(0), before) << "a list does not jump while its figures change";
  rows.tell("a unit of a long name", "1234567890123.5", "");
  const int title = list.header()->fontMetrics().horizontalAdvance("D [a unit of a long name]");
  EXPECT_GT(title, before) << "else nothing is tested";
  EXPECT_GE(list.columnWidth(0), title);
  EXPECT_GE(list.columnWidth(0), cells_px(list));
  list.header()->resizeSection(0, 45);
  rows.tell("m", "1.5", "");
  EXPECT_EQ(list.columnWidth(0), 45) << "a hand's own";
}

TEST(ListColumns, TellStandardErrorsWhereThereIsRoom) {
  Told rows;
  RowsView view(rows, false);
  view.resize(600, 200);
  view.show();
  auto& list = *view.findChild<QTreeView*>("rows");
  const auto looks = [&] { return list.viewport()->grab().toImage(); };
  const QFontMetrics& font = list.fontMetrics();
  EXPECT_GE(list.columnWidth(0), font.horizontalAdvance("1.5 \u00B1 0.1"));
  const QImage told = looks();
  rows.tell("m", "1.5", "1.5 \u00B1 0.7");
  EXPECT_NE(looks(), told) << "the error is on the screen, not under the pointer alone";
  view.resize(120, 200);
  EXPECT_LT(list.columnWidth(0), font.horizontalAdvance("1.5 \u00B1 0.7"));
  const QImage brief = looks();
  rows.tell("m", "1.5", "1.5 \u00B1 0.1");
  EXPECT_EQ(looks(), brief) << "nothing is cut where it has no room";
  list.header()->resizeSection(0, 100);
  const QImage wide = looks();
  rows.tell("m", "1.5", "1.5 \u00B1 0.7");
  EXPECT_NE(looks(), wide) << "a hand gave it room";
}

TEST_F(Lists, AReviewIsThreeKeysASchool) {
  make_schools();
  const std::size_t all = rows("schools").rows();
  raise("review");
  app_->preferences.advance = true;
  key(Qt::Key_N);
  for (std::size_t i = 0; i < all; ++i) {
    ASSERT_TRUE(workspace().school());
    key(Qt::Key_2);
    key(i % 2 == 0 ? Qt::Key_A : Qt::Key_R);
  }
  std::size_t accepted = 0;
  std::size_t rejected = 0;
  for (const std::size_t observation : {0U, 1U}) {
    for (const auto& school : document().state(observation).schools) {
      accepted += school->masks.decided.status == "accepted" ? 1U : 0U;
      rejected += school->masks.decided.status == "rejected" ? 1U : 0U;
    }
  }
  EXPECT_EQ(accepted, (all + 1) / 2);
  EXPECT_EQ(rejected, all / 2);
}

TEST_F(Lists, KeysDecideAboutAllRowsThatAreSelected) {
  make_schools();
  app_->preferences.advance = false;
  click_row("schools", 0);
  const auto first = workspace().school();
  click_row("schools", 2, Qt::ControlModifier);
  ASSERT_EQ(workspace().chosen_schools().size(), 2U);
  key(Qt::Key_R);
  EXPECT_EQ(with_status("rejected"), 2U);
  EXPECT_EQ(document().choices().undo_text, "Undo reject 2 schools");
  EXPECT_EQ(list("schools").selectionModel()->selectedRows().size(), 2) << "seen to be selected still";
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(with_status("rejected"), 0U);
  EXPECT_EQ(workspace().chosen_schools().size(), 2U);
  // A second click with Ctrl lets go of a row, and the window goes to the one that is left.
  click_row("schools", 2, Qt::ControlModifier);
  EXPECT_EQ(workspace().school(), first);
  key(Qt::Key_A);
  EXPECT_EQ(with_status("accepted"), 1U);
}

TEST_F(Lists, SpeciesAndCommentsAreOfAllRowsThatAreSelected) {
  make_schools();
  app_->preferences.advance = false;
  click_row("schools", 0);
  click_row("schools", 2, Qt::ControlModifier);
  const auto chosen = workspace().chosen_schools();
  ASSERT_EQ(chosen.size(), 2U);
  key(Qt::Key_2);
  with_dialog([this] { find_action(*window_, "school.comment")->trigger(); },
              [](QDialog& dialog) {
                auto* line = dialog.findChild<QLineEdit*>();
                ASSERT_NE(line, nullptr);
                QTest::keyClicks(line, "two layers");
                QTest::keyClick(line, Qt::Key_Return);
              });
  settle();
  for (const SurveySchool& school : survey_schools(document())) {
    const bool one_of_them = chosen.contains(school.name);
    EXPECT_EQ(school.decided().species, one_of_them ? "mackerel" : "") << school.name.number;
    EXPECT_EQ(school.decided().comment, one_of_them ? "two layers" : "") << school.name.number;
  }
  EXPECT_EQ(document().choices().undo_text, "Undo comment on 2 schools");
}

TEST_F(Lists, AnUndoneDecisionBringsItsSchoolBackIntoSight) {
  make_schools();
  app_->preferences.advance = false;
  click_row("schools", 0);
  const auto first = workspace().school();
  ASSERT_TRUE(first);
  key(Qt::Key_R);
  click_row("schools", static_cast<int>(rows("schools").rows()) - 1);
  ASSERT_NE(workspace().school()->observation, first->observation) << "far away";
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(with_status("rejected"), 0U);
  EXPECT_EQ(workspace().school(), first);
  EXPECT_EQ(document().shown()->index(), first->observation);
  const auto selected = workspace().selected();
  ASSERT_TRUE(selected);
  EXPECT_NE(in_ping(document().state().schools[*selected]->masks, document().ping()), nullptr);
}

TEST_F(Lists, KeysDecideAboutNoRowThatIsNotSeen) {
  make_schools();
  app_->preferences.advance = false;
  click_row("schools", 0);
  click_row("schools", 2, Qt::ControlModifier);
  ASSERT_EQ(workspace().chosen_schools().size(), 2U);
  raise("review");
  EXPECT_TRUE(workspace().chosen_schools().empty()) << "the table is behind a tab";
  raise("schools");
  EXPECT_EQ(list("schools").selectionModel()->selectedRows().size(), 1);
  click_row("schools", 0);
  click_row("schools", 2, Qt::ControlModifier);
  ASSERT_EQ(document().shown()->name(), "obs-0002");
  QLineEdit& line = filter("schools");
  click_on(&line, {20.0, 0.5 * line.height()});
  type("obs-0002");
  EXPECT_TRUE(workspace().chosen_schools().empty()) << "the filter hides one of the two";
  list("schools").setFocus();
  key(Qt::Key_R);
  EXPECT_EQ(with_status("rejected"), 1U);
  EXPECT_EQ(document().state(1).schools.front()->masks.decided.status, "rejected");
}

TEST_F(Lists, TheTabOfTheReviewCountsWhatIsLeft) {
  EXPECT_EQ(dock("review")->windowTitle(), "Review");
  make_schools();
  const std::size_t all = rows("schools").rows();
  EXPECT_EQ(dock("review")->windowTitle().toStdString(), fmt::format("Review: {} of {} left", all, all));
  key(Qt::Key_N);
  key(Qt::Key_A);
  EXPECT_EQ(dock("review")->windowTitle().toStdString(), fmt::format("Review: {} of {} left", all - 1, all))
      << "also behind another tab";
}

}  // namespace
}  // namespace sonar
