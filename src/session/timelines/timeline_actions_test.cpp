// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include "session/app_parts.h"
#include "session/maps/test_maps.h"
#include "session/timelines/timeline_painter.h"

namespace sonar {
namespace {

/// An app with the actions of timelines, over a survey and its journal.
class TimelineActions : public testing::Test {
 protected:
  void SetUp() override { reopen(); }
  void reopen() {
    app_.reset();
    app_ = std::make_unique<AppModel>(queue_, TestSurvey::options(journal_));
    if (app_->actions.find("event.trawl") == nullptr) add_maps(*app_);
    app_->dialogs.text = [this](const std::string&, const std::string&, const std::string&) { return answer_; };
    document().open({TestSurvey::easy().folder()});
    document().settle();
  }
  Document& document() { return app_->workspace.document; }
  void ask(const std::string& id) {
    const Action* action = app_->actions.find(id);
    ASSERT_NE(action, nullptr) << id;
    EXPECT_TRUE(!action->enabled || action->enabled()) << id;
    action->run();
    document().settle();
  }

  std::filesystem::path journal_ = TestSurvey::easy().fresh();
  std::string answer_ = "cod end full";
  ChangeQueue queue_;
  std::unique_ptr<AppModel> app_;
};

TEST_F(TimelineActions, AnEventIsALineOfTheJournalAndIsThereAfterReopening) {
  document().look_at(6);
  document().settle();
  ask("event.trawl");
  const TimeNs time = document().shown()->context().times[6];
  const auto journal = read_journal(document().journal_path().string());
  ASSERT_TRUE(journal);
  ASSERT_EQ(journal->lines.size(), 1U);
  EXPECT_EQ(journal->lines[0].command, "event");
  reopen();
  ASSERT_EQ(document().state().events.size(), 1U);
  EXPECT_EQ(document().state().events[0].kind, "trawl");
  EXPECT_EQ(document().state().events[0].time, time);
  EXPECT_EQ(document().state().events[0].text, "cod end full");
  EXPECT_EQ(shown_time(*document().shown(), time), document().shown()->files().navigation[6].time);
  ask("event.next");
  EXPECT_EQ(document().ping(), 6);
  answer_.clear();
  ask("event.station");
  EXPECT_EQ(document().state().events.size(), 1U) << "no answer, no event";
}

TEST_F(TimelineActions, PingsOfABadIntervalTakeNoPartInMeasuresUntilItIsUndone) {
  document().detect({0});
  document().settle();
  const auto before = document().product(0);
  const auto rows_in = [](const ObservationProduct& product, std::int64_t first, std::int64_t last) {
    return std::count_if(product.school_pings.begin(), product.school_pings.end(),
                         [&](const auto& row) { return row.ping_index >= first && row.ping_index <= last; });
  };
  const std::int64_t from = before->school_pings.front().ping_index;
  ASSERT_GT(rows_in(*before, from, from + 1), 0);
  app_->workspace.marked_interval.set(MarkedInterval{0, from, from + 1});
  ask("bad.interval");
  EXPECT_FALSE(app_->workspace.marked_interval());
  EXPECT_EQ(rows_in(*document().product(0), from, from + 1), 0);
  EXPECT_TRUE(document().product(0)->pings[static_cast<std::size_t>(from)].bad);
  document().undo();
  document().settle();
  EXPECT_EQ(document().product(0)->school_pings.size(), before->school_pings.size());
}

TEST_F(TimelineActions, DeleteTakesTheChosenMarkAwayAndUndoBringsItBack) {
  document().look_at(6);
  document().settle();
  ask("event.trawl");
  ask("bad.ping");
  const auto state = [&]() -> const JournalState& { return document().state(); };
  app_->workspace.mark.set(ChosenMark{0, state().events.at(0)});
  EXPECT_EQ(app_->actions.find("school.delete")->text_now(), "Remove mark trawl");
  ask("school.delete");
  EXPECT_FALSE(app_->workspace.mark());
  EXPECT_TRUE(state().events.empty());
  EXPECT_EQ(document().choices().undo_text, "Undo remove mark trawl");
  app_->workspace.mark.set(ChosenMark{0, state().bad_pings.at(0)});
  ask("mark.remove");
  EXPECT_TRUE(state().bad_pings.empty());
  EXPECT_EQ(document().choices().undo_text, "Undo mark good ping");
  reopen();
  EXPECT_TRUE(state().events.empty() && state().bad_pings.empty()) << "it stands in the journal";
  document().undo();
  document().undo();
  document().settle();
  EXPECT_EQ(state().events.size(), 1U);
  EXPECT_EQ(state().bad_pings.size(), 1U);
  // Of an interval a part can be made good.
  app_->workspace.marked_interval.set(MarkedInterval{0, 2, 6});
  ask("bad.interval");
  app_->workspace.marked_interval.set(MarkedInterval{0, 4, 6});
  ask("good.interval");
  const auto& times = document().shown()->context().times;
  EXPECT_TRUE(is_bad(state(), times[3]));
  for (const std::size_t ping : {1U, 4U, 6U, 7U}) EXPECT_FALSE(is_bad(state(), times[ping])) << ping;
}

TEST_F(TimelineActions, ABadPingIsTheOneOnShow) {
  document().look_at(4);
  document().settle();
  ask("bad.ping");
  ASSERT_EQ(document().state().bad_pings.size(), 1U);
  EXPECT_EQ(document().state().bad_pings[0].first, document().shown()->context().times[4]);
  EXPECT_EQ(document().state().bad_pings[0].last, document().shown()->context().times[4]);
}

}  // namespace
}  // namespace sonar
