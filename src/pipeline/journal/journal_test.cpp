// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "base/test_full_disk.h"
#include "pipeline/journal/named_lock.h"

namespace sonar {
namespace {

class JournalFile : public testing::Test {
 protected:
  void SetUp() override {
    path_ = (std::filesystem::temp_directory_path() /
             (std::string("sonar-journal-") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".jsonl"))
                .string();
    std::remove(path_.c_str());
  }
  void TearDown() override { std::remove(path_.c_str()); }

  void append(std::int64_t n, const char* command, nlohmann::json args = nlohmann::json::object()) {
    JournalLine line;
    line.n = n;
    line.command = command;
    line.ping_time = 1'000'000'000 * n;
    *line.args = std::move(args);
    ASSERT_TRUE(append_journal(path_, head_, line));
  }
  std::string text() {
    std::ifstream in(path_);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void overwrite(const std::string& text) { std::ofstream(path_) << text; }

  std::string path_;
  Journal head_{{{"a.raw", 12, "ab"}}, "cd", "{\"recipe_version\": 1}", {}, {}};
};

TEST_F(JournalFile, ReadsBackWhatWasAppended) {
  append(1, "propagate", {{"seeds", {{{"channel", 3}, {"sample", 400}}}}});
  append(2, "undo", {{"target", 1}});
  const auto journal = read_journal(path_);
  ASSERT_TRUE(journal) << journal.error().text;
  EXPECT_EQ(journal->files, head_.files);
  EXPECT_EQ(journal->recipe_hash, "cd");
  EXPECT_THAT(journal->recipe, testing::HasSubstr("recipe_version"));
  ASSERT_EQ(journal->lines.size(), 2U);
  EXPECT_EQ((*journal->lines[0].args)["seeds"][0]["sample"], 400);
  EXPECT_EQ(journal->lines[1].ping_time, 2'000'000'000);
  EXPECT_TRUE(journal->diagnostics.empty());
}

TEST_F(JournalFile, BrokenLineIsReportedAndTheRestKept) {
  append(1, "propagate");
  append(2, "propagate");
  append(3, "propagate");
  std::string damaged = text();
  const auto second = damaged.find("\"n\":2");
  damaged[second + 4] = '7';  // the check sum no longer fits
  overwrite(damaged);
  const auto journal = read_journal(path_);
  ASSERT_TRUE(journal);
  ASSERT_EQ(journal->lines.size(), 2U);
  EXPECT_EQ(journal->lines[0].n, 1);
  EXPECT_EQ(journal->lines[1].n, 3);
  ASSERT_EQ(journal->diagnostics.size(), 1U);
  EXPECT_EQ(journal->diagnostics[0].code, DiagnosticCode::journal_line);
}

TEST_F(JournalFile, LineCutByACrashLosesNothingElse) {
  append(1, "propagate");
  append(2, "propagate");
  overwrite(text().substr(0, text().size() - 9));
  const auto journal = read_journal(path_);
  ASSERT_TRUE(journal);
  ASSERT_EQ(journal->lines.size(), 1U);
  EXPECT_EQ(journal->diagnostics.size(), 1U);
  append(3, "propagate");  // nor the line that comes next
  const auto longer = read_journal(path_);
  ASSERT_TRUE(longer);
  ASSERT_EQ(longer->lines.size(), 2U);
  EXPECT_EQ(longer->lines[1].n, 3);
}

// Wherever the disk gets full, in the head, in the line or behind it: the file is as it was, and goes on when there is room.
TEST_F(JournalFile, AFullDiskRefusesTheLineAndLeavesTheFileAsItWas) {
  JournalLine line;
  line.n = 2;
  line.command = "comment";
  *line.args = {{"comment", std::string(300, 'x')}};
  for (const bool fresh : {true, false}) {
    std::remove(path_.c_str());
    if (!fresh) append(1, "propagate");
    const std::string before = fresh ? std::string{} : text();
    const std::size_t whole =
        before.size() + (fresh ? journal_head_text(head_).size() + 1 : 0) + journal_text(line).size() + 1;
    for (std::size_t room = before.size(); room < whole; room += 7) {
      {
        const FullDisk disk(room);
        const auto written = append_journal(path_, head_, line);
        ASSERT_FALSE(written) << room;
        EXPECT_EQ(written.error().code, ErrorCode::no_space);
        EXPECT_THAT(to_line(written.error()), testing::StartsWith(path_ + ": could not be written: "));
      }
      ASSERT_EQ(text(), before) << room;
    }
    const FullDisk disk(whole);
    ASSERT_TRUE(append_journal(path_, head_, line));
    const auto journal = read_journal(path_);
    ASSERT_TRUE(journal);
    EXPECT_TRUE(journal->diagnostics.empty());
    EXPECT_EQ(journal->lines.back().n, 2);
  }
}

TEST_F(JournalFile, NewerVersionIsRefusedByName) {
  overwrite("{\"journal_version\":2}\n");
  const auto journal = read_journal(path_);
  ASSERT_FALSE(journal);
  EXPECT_EQ(journal.error().code, ErrorCode::newer_version);
  overwrite("");
  EXPECT_FALSE(read_journal(path_));
}

TEST_F(JournalFile, ABrokenHeadLeavesTheChoicesBehindIt) {
  append(1, "propagate");
  append(2, "detect");
  const std::string whole = text();
  overwrite("{\1" + whole.substr(2));
  const auto journal = read_journal(path_);
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal->lines.size(), 2U);
  ASSERT_EQ(journal->diagnostics.size(), 1U);
  EXPECT_THAT(journal->diagnostics[0].text, testing::HasSubstr("recipe"));
  EXPECT_TRUE(journal->recipe.empty());
  overwrite("notes of a meeting\nand more\n");
  EXPECT_EQ(read_journal(path_).error().code, ErrorCode::format);
}

TEST_F(JournalFile, NothingIsWrittenThroughALink) {
  const std::string elsewhere = path_ + ".others";
  std::filesystem::create_symlink(elsewhere, path_);
  JournalLine line;
  line.n = 1;
  EXPECT_FALSE(append_journal(path_, head_, line));
  NamedLock lock;
  EXPECT_FALSE(lock.take(path_, "", 0));
  EXPECT_FALSE(std::filesystem::exists(elsewhere));
}

TEST(Journal, ANumberAfterWhichNoneCouldComeIsBroken) {
  JournalLine line;
  line.command = "undo";
  for (const std::int64_t n : {std::numeric_limits<std::int64_t>::max(), std::int64_t{0}, std::int64_t{-1}}) {
    line.n = n;
    const auto read = parse_journal(journal_head_text({}) + "\n" + journal_text(line) + "\n", "j");
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->lines.empty()) << n;
    EXPECT_EQ(read->diagnostics.size(), 1U);
  }
}

TEST(Journal, ALineSaysOfWhichStepItIsAndOthersSayNothing) {
  JournalLine line;
  line.n = 8;
  line.command = "detect";
  EXPECT_THAT(journal_text(line), testing::Not(testing::HasSubstr("step")));
  line.step = 7;
  const auto read = parse_journal(journal_head_text({}) + "\n" + journal_text(line) + "\n", "j");
  ASSERT_TRUE(read);
  ASSERT_EQ(read->lines.size(), 1U);
  EXPECT_EQ(read->lines[0].step, 7);
}

TEST(Journal, UndoAndRedoNameTheirTarget) {
  const auto line = [](std::int64_t n, const char* command, std::int64_t target) {
    JournalLine made;
    made.n = n;
    made.command = command;
    if (target > 0) *made.args = {{"target", target}};
    return made;
  };
  const std::vector<JournalLine> lines = {line(1, "propagate", 0), line(2, "propagate", 0), line(3, "undo", 1),
                                          line(4, "undo", 2), line(5, "redo", 1)};
  const auto kept = effective_lines(lines);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept[0].n, 1);
}

}  // namespace
}  // namespace sonar
