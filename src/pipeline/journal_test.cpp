// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

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
    line.args = std::move(args);
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
  EXPECT_EQ(journal->lines[0].args["seeds"][0]["sample"], 400);
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

TEST_F(JournalFile, NewerVersionIsRefusedByName) {
  overwrite("{\"journal_version\":2}\n");
  const auto journal = read_journal(path_);
  ASSERT_FALSE(journal);
  EXPECT_EQ(journal.error().code, ErrorCode::newer_version);
  overwrite("");
  EXPECT_FALSE(read_journal(path_));
}

TEST(Journal, UndoAndRedoNameTheirTarget) {
  const auto line = [](std::int64_t n, const char* command, std::int64_t target) {
    JournalLine made;
    made.n = n;
    made.command = command;
    if (target > 0) made.args = {{"target", target}};
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
