// SPDX-License-Identifier: Apache-2.0
// Several people at work on one survey: a journal each, an observation held by one, and everybody may look.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "session/test_survey.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

class SeveralPeople : public testing::Test {
 protected:
  struct Window {
    ChangeQueue queue;
    std::unique_ptr<Document> document;
    Document* operator->() const { return document.get(); }

    void mark(std::int64_t ping, const std::string& text) const {
      document->act(EventCommand{"trawl", document->shown()->context().times[static_cast<std::size_t>(ping)], text});
      document->settle();
    }
    [[nodiscard]] std::size_t events() const { return document->state().events.size(); }
    void go_to(std::size_t observation) const {
      ASSERT_TRUE(document->show(observation));
      document->settle();
    }
    /// As somebody does who goes to and fro.
    void look_again() const { go_to(document->shown()->index()); }
    void undo() const {
      document->undo();
      document->settle();
    }
  };

  [[nodiscard]] std::unique_ptr<Window> window(const std::string& name, TimeNs clock_ahead = 0) const {
    auto window = std::make_unique<Window>();
    DocumentOptions options = TestSurvey::options(work_);
    options.operator_name = name;
    options.clock = [clock_ahead] { return TimeNs{1'790'000'000} * kSecondNs + clock_ahead; };
    window->document = std::make_unique<Document>(window->queue, std::move(options));
    (*window)->open({TestSurvey::easy().folder()});
    (*window)->settle();
    return window;
  }
  [[nodiscard]] bool has(const char* file) const { return fs::exists(work_ / file); }
  [[nodiscard]] std::vector<fs::path> locks() const {
    std::vector<fs::path> list;
    std::error_code absent;
    for (const auto& entry : fs::directory_iterator(work_ / "locks", absent)) list.push_back(entry.path());
    return list;
  }

  fs::path work_ = TestSurvey::easy().fresh();
};

TEST_F(SeveralPeople, EachHasAJournalAndSeesWhatTheOthersChose) {
  const auto anna = window("anna");
  const auto bent = window("bent");
  anna->mark(2, "anna's");
  bent->go_to(1);
  bent->mark(3, "bent's");
  EXPECT_TRUE(has("session.jsonl") && has("session-2.jsonl"));
  EXPECT_EQ(read_journal((work_ / "session.jsonl").string())->lines.size(), 1U);
  EXPECT_EQ(read_journal((work_ / "session-2.jsonl").string())->lines.front().n, 1);
  EXPECT_THAT((*bent)->notices(), Contains(HasSubstr("anna (host ")));
  bent->go_to(0);
  EXPECT_EQ(bent->events(), 1U) << "what anna chose";
  anna->go_to(1);
  EXPECT_EQ(anna->events(), 1U) << "what bent chose";
  // Whoever comes later sees both, and a run on the folder carries out both.
  const auto carl = window("carl");
  EXPECT_EQ(carl->events(), 1U);
  EXPECT_EQ((*carl)->choices().lines->size(), 2U);
  EXPECT_EQ(read_session(work_)->lines.size(), 2U);
}

TEST_F(SeveralPeople, AnObservationIsHeldByWhoeverChoosesInItWhileTheyLookAtIt) {
  const auto anna = window("anna");
  const auto bent = window("bent");
  anna->mark(2, "");
  bent->mark(3, "");
  EXPECT_THAT((*bent)->notices().back(), HasSubstr("anna (host "));
  EXPECT_THAT((*bent)->notices().back(), HasSubstr("is at work on obs-0001"));
  EXPECT_FALSE(has("session-2.jsonl"));
  ASSERT_TRUE((*anna)->show(1));  // she goes on elsewhere
  (*anna)->settle();
  bent->mark(3, "");
  EXPECT_THAT((*bent)->notices().back(), HasSubstr("others have chosen in obs-0001 since"));
  EXPECT_EQ(bent->events(), 1U) << "hers is shown first";
  bent->mark(3, "");
  EXPECT_EQ(bent->events(), 2U);
  anna->look_again();
  anna->go_to(0);
  EXPECT_EQ(anna->events(), 2U);
  anna->undo();
  EXPECT_THAT((*anna)->notices().back(), HasSubstr("bent (host ")) << "he holds it now";
}

TEST_F(SeveralPeople, WhoOnlyLooksSeesWhatIsChosenMeanwhile) {
  const auto bent = window("bent");
  const auto anna = window("anna");
  anna->mark(2, "");
  bent->look_again();
  EXPECT_EQ(bent->events(), 1U);
  anna->mark(3, "");
  bent->look_again();
  EXPECT_EQ(bent->events(), 2U);
  EXPECT_FALSE(has("session-2.jsonl"));
}

// A journal is locked before its first line is written, and may stay without one.
TEST_F(SeveralPeople, AThirdPersonFindsAJournalOfTheirOwn) {
  const auto anna = window("anna");
  const auto bent = window("bent");
  const auto carl = window("carl");
  anna->mark(2, "");
  bent->mark(3, "");  // refused: anna is at work there
  EXPECT_FALSE(has("session-2.jsonl"));
  carl->go_to(1);
  carl->mark(2, "");
  EXPECT_EQ(carl->events(), 1U);
  EXPECT_TRUE(has("session-3.jsonl"));
}

TEST_F(SeveralPeople, WhoComesAfterSomebodyWhoLeftIsShownTheirChoiceFirst) {
  const auto bent = window("bent");
  {
    const auto anna = window("anna");
    anna->mark(2, "hers");
  }
  bent->mark(3, "his");
  EXPECT_THAT((*bent)->notices().back(), HasSubstr("others have chosen in obs-0001 since"));
  EXPECT_EQ(bent->events(), 1U);
  bent->mark(3, "his");
  EXPECT_EQ(bent->events(), 2U);
  EXPECT_TRUE(has("session-2.jsonl")) << "hers stays hers";
  // The day after, each goes on in their own.
  EXPECT_EQ((*window("anna"))->journal_path().filename(), "session.jsonl");
  EXPECT_EQ((*window("bent"))->journal_path().filename(), "session-2.jsonl");
}

TEST_F(SeveralPeople, WhatOthersHoldIsLeftOutOfASearchOfAll) {
  const auto anna = window("anna");
  anna->mark(2, "");
  const auto bent = window("bent");
  (*bent)->open_all();
  (*bent)->settle();
  (*bent)->detect({0, 1});
  (*bent)->settle();
  EXPECT_THAT((*bent)->notices(), Contains(HasSubstr("is at work on obs-0001")));
  EXPECT_FALSE((*bent)->asks_for_schools(0));
  EXPECT_TRUE((*bent)->asks_for_schools(1));
}

// Numbers in a journal are its own.
TEST_F(SeveralPeople, UndoAndRedoInASecondJournalComeBack) {
  const auto anna = window("anna");
  anna->mark(2, "hers");
  {
    const auto bent = window("bent");
    bent->go_to(1);
    bent->mark(2, "first");
    bent->mark(3, "second");
    bent->undo();
    EXPECT_EQ(bent->events(), 1U);
  }
  const auto lines = read_journal((work_ / "session-2.jsonl").string())->lines;
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[2].args->at("target"), 2);
  const auto bent = window("bent");
  bent->go_to(1);
  EXPECT_EQ(bent->events(), 1U);
  (*bent)->redo();
  (*bent)->settle();
  EXPECT_EQ(bent->events(), 2U);
}

// Also where the observation is not open here.
TEST_F(SeveralPeople, NothingIsUndoneWhereAnotherIsAtWork) {
  {
    const auto anna = window("anna");
    anna->go_to(1);
    anna->mark(2, "hers");
  }
  const auto bent = window("bent");
  bent->go_to(1);
  bent->mark(3, "his");
  const auto anna = window("anna");
  anna->undo();
  EXPECT_THAT((*anna)->notices().back(), HasSubstr("is at work on obs-0002"));
  EXPECT_EQ(effective_lines(read_session(work_)->lines).size(), 2U);
}

TEST_F(SeveralPeople, NobodyUndoesWhatAnotherChose) {
  const auto anna = window("anna");
  anna->mark(2, "hers");
  const auto bent = window("bent");
  bent->undo();
  EXPECT_THAT((*bent)->notices().back(), HasSubstr("nothing to undo"));
  anna->go_to(1);
  bent->look_again();
  bent->mark(4, "his");
  bent->go_to(1);
  anna->undo();
  anna->go_to(0);
  if (anna->events() == 2U) anna->undo();  // she was shown his first
  ASSERT_EQ(anna->events(), 1U);
  EXPECT_EQ((*anna)->state().events.front().text, "his");
}

// Clocks of two machines differ: what came later by the locks comes later in the state of everybody.
TEST_F(SeveralPeople, ASlowClockDoesNotPutAChoiceBeforeThoseItStandsOn) {
  const auto anna = window("anna", 3600 * kSecondNs);
  anna->mark(2, "first");
  anna->go_to(1);
  const auto bent = window("bent");
  bent->mark(2, "second");
  EXPECT_GE((*bent)->choices().lines->back().decided, (*bent)->choices().lines->front().decided);
  EXPECT_EQ((*bent)->choices().lines->back().operator_name, "bent");
  EXPECT_EQ((*window("carl"))->choices().lines->back().operator_name, "bent");
  // Nor where theirs is the journal that comes first.
  anna->look_again();
  bent->go_to(1);
  anna->look_again();
  anna->go_to(0);
  anna->mark(4, "third");
  const auto lines = (*window("carl"))->choices().lines;
  ASSERT_EQ(lines->size(), 3U);
  EXPECT_EQ(lines->back().operator_name, "anna");
  EXPECT_LT((*lines)[1].decided, (*lines)[2].decided);
}

TEST_F(SeveralPeople, WhoeverClosesTheWindowLeavesNoLocks) {
  auto anna = window("anna");
  EXPECT_TRUE(locks().empty()) << "looking locks nothing";
  anna->mark(2, "");
  EXPECT_EQ(locks().size(), 2U);
  anna.reset();
  EXPECT_TRUE(locks().empty());
}

// What a program that was killed leaves: the file, and nobody who holds it.
TEST_F(SeveralPeople, ALockOfAProgramThatIsGoneIsToldAndTakenOver) {
  std::map<fs::path, std::string> left;
  {
    const auto anna = window("anna");
    anna->mark(2, "");
    for (const fs::path& lock : locks()) {
      std::ifstream in(lock);
      left[lock] = {std::istreambuf_iterator<char>(in), {}};
    }
  }
  ASSERT_EQ(left.size(), 2U);
  for (const auto& [lock, text] : left) std::ofstream(lock) << text;
  auto bent = window("bent");
  bent->mark(3, "");
  EXPECT_EQ(bent->events(), 2U);
  EXPECT_THAT((*bent)->notices(), Contains(HasSubstr("was left by a program that has ended")));
  bent.reset();
  // Of another machine's nobody here can tell whether it has ended.
  for (auto [lock, text] : left) {
    const auto at = text.find("\"host\":\"") + 8;
    text.insert(at, "far-away-");
    std::ofstream(lock) << text;
  }
  const auto carl = window("carl");
  carl->mark(4, "");
  EXPECT_EQ(carl->events(), 2U);
  EXPECT_THAT((*carl)->notices().back(), HasSubstr("anna (host far-away-"));
  EXPECT_THAT((*carl)->notices().back(), HasSubstr("if that program is gone, remove "));
}

TEST_F(SeveralPeople, ALockThatNamesNobodyIsOneLine) {
  fs::create_directories(work_ / "locks");
  std::ofstream(work_ / "locks" / "session.jsonl.lock") << "[";
  const auto anna = window("anna");
  anna->mark(2, "");
  EXPECT_EQ(anna->events(), 0U);
  EXPECT_THAT((*anna)->notices().back(), HasSubstr("names nobody"));
}

}  // namespace
}  // namespace sonar
