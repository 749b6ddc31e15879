// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/taken_lines.h"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "base/test_paths.h"
#include "pipeline/journal/journals.h"
#include "pipeline/journal/named_lock.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class Taken : public testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] JournalPlace placed() const {
    const std::array folders{folder_ / "work"};
    auto place = place_journal(folders, {}, "bob");
    EXPECT_TRUE(place);
    return place ? *place : JournalPlace{};
  }
  static JournalLine line(std::int64_t n, TimeNs decided_ms, const char* command, const char* who = "ann") {
    JournalLine line;
    line.n = n;
    line.decided = decided_ms * (kSecondNs / 1000);
    line.operator_name = who;
    line.command = command;
    line.ping_time = 7;
    return line;
  }
  /// The survey has a ping at 7.
  [[nodiscard]] Result<TakenLines> take(const fs::path& from) const {
    return take_lines(placed(), from, [](TimeNs time) { return time == 7; });
  }
  void write(const fs::path& path, const JournalLine& line) const {
    fs::create_directories(path.parent_path());
    ASSERT_TRUE(append_journal(path.string(), {}, line));
  }
  fs::path folder_ = test::scratch_path("-taken");
  fs::path theirs_ = folder_ / "theirs" / "chosen.jsonl";
};

TEST_F(Taken, LinesThatHoldComeWithTheirPersonAndTimeAsOneStep) {
  write(theirs_, line(1, 100, "delete"));
  write(theirs_, line(2, 200, "brush"));
  write(theirs_, line(3, 300, "merge"));
  JournalLine undo = line(4, 400, "undo");
  *undo.args = {{"target", 2}};
  write(theirs_, undo);
  const auto taken = take(theirs_);
  ASSERT_TRUE(taken) << to_line(taken.error());
  EXPECT_EQ(taken->lines, 2U) << "what was undone is not taken";
  EXPECT_EQ(taken->operators, std::vector<std::string>{"ann"});
  const JournalPlace place = placed();
  ASSERT_EQ(place.lines.size(), 2U);
  EXPECT_EQ(place.lines[0].command, "delete");
  EXPECT_EQ(place.lines[1].command, "merge");
  EXPECT_EQ(place.lines[1].decided, 300 * (kSecondNs / 1000));
  EXPECT_EQ(place.lines[1].operator_name, "ann");
  EXPECT_EQ(place.lines[0].step, place.lines[0].n);
  EXPECT_EQ(place.lines[1].step, place.lines[0].n);
}

TEST_F(Taken, WhatIsThereAlreadyIsNotTakenAgain) {
  write(theirs_, line(1, 100, "delete"));
  ASSERT_EQ(take(theirs_)->lines, 1U);
  EXPECT_EQ(take(theirs_)->lines, 0U);
  write(theirs_, line(2, 200, "delete"));  // the same act again, at another time
  EXPECT_EQ(take(theirs_)->lines, 1U);
  EXPECT_EQ(placed().lines.size(), 2U);
}

// Two windows open the same results at one moment: the second has read the journals before the first wrote.
TEST_F(Taken, WhatAnotherWindowTookMeanwhileIsNotTakenAgain) {
  write(theirs_, line(1, 100, "delete"));
  const JournalPlace before = placed();
  ASSERT_EQ(take(theirs_)->lines, 1U);
  EXPECT_EQ(take_lines(before, theirs_, [](TimeNs) { return true; })->lines, 0U);
  EXPECT_EQ(placed().lines.size(), 1U);
}

TEST_F(Taken, JournalsThatAreThereStayAsTheyAre) {
  const fs::path ours = folder_ / "work" / "session.jsonl";
  write(ours, line(1, 50, "brush", "bob"));
  write(theirs_, line(1, 100, "delete"));
  const auto taken = take(theirs_);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->into, folder_ / "work" / "session-2.jsonl");
  const auto still = read_journal(ours.string());
  ASSERT_TRUE(still);
  EXPECT_EQ(still->lines.size(), 1U);
  const JournalPlace place = placed();
  EXPECT_EQ(place.lines.size(), 2U);
  EXPECT_EQ(place.path, ours) << "bob goes on with his own";
}

TEST_F(Taken, NothingOfAnotherSurvey) {
  JournalLine other = line(1, 100, "delete");
  other.ping_time = 8;
  write(theirs_, other);
  EXPECT_EQ(take(theirs_)->lines, 0U);
  EXPECT_FALSE(fs::exists(folder_ / "work" / "session.jsonl"));
  write(theirs_, line(2, 200, "brush"));
  EXPECT_EQ(take(theirs_)->lines, 2U) << "a line of a ping that is not there yet stays with the others";
}

TEST_F(Taken, AJournalThatSomebodyIsAboutToBeginIsLeftAlone) {
  write(theirs_, line(1, 100, "delete"));
  NamedLock lock;
  ASSERT_TRUE(lock.take(journal_lock(folder_ / "work" / "session.jsonl"), "bob", 1));
  const auto taken = take(theirs_);
  ASSERT_TRUE(taken) << to_line(taken.error());
  EXPECT_EQ(taken->into, folder_ / "work" / "session-2.jsonl");
}

TEST_F(Taken, AJournalThatIsGoneIsSaid) {
  EXPECT_EQ(take(folder_ / "none.jsonl").error().code, ErrorCode::not_found);
  EXPECT_TRUE(placed().lines.empty());
}

}  // namespace
}  // namespace sonar
