// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/journals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

JournalLine line(std::int64_t n, TimeNs decided, const std::string& command = "event", std::int64_t target = 0) {
  JournalLine made;
  made.n = n;
  made.decided = decided;
  made.command = command;
  if (target != 0) *made.args = {{"target", target}};
  return made;
}

/// Some acts, undone and redone at random, in one person's journal.
std::vector<JournalLine> somebodys(std::mt19937& random, TimeNs time) {
  std::vector<JournalLine> lines;
  for (std::int64_t n = 1; n <= 30; ++n) {
    time += static_cast<TimeNs>(random() % 3) * kSecondNs;
    const auto kind = random() % 4;
    const auto target = static_cast<std::int64_t>(random() % static_cast<unsigned>(n)) + 1;
    if (kind == 0 && n > 1) {
      lines.push_back(line(n, time, random() % 2 == 0 ? "undo" : "redo", std::min(target, n - 1)));
    } else {
      lines.push_back(line(n, time));
    }
  }
  return lines;
}

TEST(Journals, WhatHoldsOfAllIsWhatHoldsOfEach) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::vector<JournalLine>> of_each;
    std::vector<std::pair<TimeNs, std::int64_t>> expected;
    for (std::int64_t place = 0; place < 3; ++place) {
      auto lines = somebodys(random, place * kSecondNs);
      for (const JournalLine& one : effective_lines(lines)) {
        expected.emplace_back(one.decided, among_all(one, place).n);
      }
      for (JournalLine& one : lines) {
        const JournalLine there = among_all(one, place);
        EXPECT_EQ(journal_text(as_written(there, place)), journal_text(one));
        one = there;
      }
      of_each.push_back(std::move(lines));
    }
    std::vector<std::pair<TimeNs, std::int64_t>> held;
    for (const JournalLine& one : effective_lines(joined(of_each))) held.emplace_back(one.decided, one.n);
    EXPECT_TRUE(std::ranges::is_sorted(held, {}, &std::pair<TimeNs, std::int64_t>::first));
    EXPECT_THAT(held, testing::UnorderedElementsAreArray(expected));
  }
}

// A clock that was set back in the middle of somebody's work.
TEST(Journals, EachKeepsItsOwnOrder) {
  const auto all = joined({{line(1, 5), line(2, 1)}, {among_all(line(1, 3), 1)}});
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].n, among_all(line(1, 3), 1).n);
  EXPECT_EQ(all[1].n, 1);
  EXPECT_EQ(all[2].n, 2);
}

TEST(Journals, NumbersAreForPeople) {
  EXPECT_EQ(line_title(17), "17");
  EXPECT_EQ(line_title(first_number(1)), "2:1");
  EXPECT_EQ(line_title(among_all(line(17, 0), 2).n), "3:17");
  const auto greatest = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(among_all(line(greatest, 0, "undo", greatest), 5).n, greatest) << "stays as it is";
}

TEST(Journals, AreKnownByTheirNames) {
  const test::TemporaryFolder folder;
  for (const char* name :
       {"session.jsonl", "session-2.jsonl", "session-1000.jsonl", "session-1.jsonl", "session-02.jsonl",
        "session-1001.jsonl", "session-x.jsonl", "sessions.jsonl", "session-.jsonl", "session-2.json"}) {
    std::ofstream(folder.path() / name) << "";
  }
  std::vector<std::pair<std::string, std::int64_t>> found;
  const std::array folders{folder.path()};
  for (const OneJournal& one : journals_in(folders)) found.emplace_back(one.path.filename().string(), one.place);
  EXPECT_EQ(found, (std::vector<std::pair<std::string, std::int64_t>>{
                       {"session.jsonl", 0}, {"session-2.jsonl", 1}, {"session-1000.jsonl", 999}}));
}

TEST(Journals, AFolderStandsForAllInIt) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(read_session(folder.path()).error().code, ErrorCode::not_found);
  Journal head;
  head.recipe_hash = "first";
  ASSERT_TRUE(append_journal((folder.path() / "session.jsonl").string(), head, line(1, 5 * kSecondNs)));
  head.recipe_hash = "second";
  ASSERT_TRUE(append_journal((folder.path() / "session-2.jsonl").string(), head, line(1, 4 * kSecondNs)));
  const auto session = read_session(folder.path());
  ASSERT_TRUE(session);
  EXPECT_EQ(session->lines.size(), 2U);
  EXPECT_EQ(line_title(session->lines.front().n), "2:1");
  std::ofstream(folder.path() / "session-3.jsonl") << "{\"journal_version\":2}\n";
  EXPECT_EQ(read_session(folder.path()).error().code, ErrorCode::newer_version) << "part of it would be left out";
}

}  // namespace
}  // namespace sonar
