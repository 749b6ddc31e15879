// SPDX-License-Identifier: Apache-2.0
// A folder that may be read and not written to: the journal goes elsewhere, and says so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/test_ordinary_rights.h"
#include "session/test_survey.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

TEST(ReadOnlyFolder, TheJournalGoesElsewhereAndSaysSo) {
  const fs::path locked = TestSurvey::easy().fresh();
  const fs::path own = TestSurvey::easy().fresh();
  fs::permissions(own, fs::perms::all);
  fs::permissions(locked, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::group_read |
                              fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec);
  const OrdinaryRights rights;
  if (!rights) GTEST_SKIP() << "runs as root, which no mode stops, and cannot give that up";
  ChangeQueue queue;
  {
    DocumentOptions options = TestSurvey::options(own);
    options.journal_folders = [&](const auto&) { return std::vector{locked, own}; };
    Document document(queue, std::move(options));
    document.open({TestSurvey::easy().folder()});
    document.settle();
    ASSERT_TRUE(document.shown()) << "what can be read is shown";
    EXPECT_THAT(document.notices(),
                testing::Contains(testing::AllOf(testing::HasSubstr(locked.string() + " cannot be written to"),
                                                 testing::HasSubstr(own.string()))));
    document.act(EventCommand{"trawl", document.shown()->context().times[1], "kept"});
    document.settle();
    EXPECT_EQ(document.state().events.size(), 1U);
  }
  EXPECT_TRUE(fs::exists(own / "session.jsonl"));
  EXPECT_TRUE(fs::is_empty(locked));
}

TEST(ReadOnlyFolder, WhereNothingCanBeWrittenTheSurveyIsShownAndActsAreRefused) {
  const fs::path locked = TestSurvey::easy().fresh();
  fs::permissions(locked, fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write,
                  fs::perm_options::remove);
  const OrdinaryRights rights;
  if (!rights) GTEST_SKIP() << "runs as root, which no mode stops, and cannot give that up";
  ChangeQueue queue;
  Document document(queue, TestSurvey::options(locked));
  document.open({TestSurvey::easy().folder()});
  document.settle();
  ASSERT_TRUE(document.shown());
  EXPECT_THAT(document.notices(), testing::Contains(testing::HasSubstr("no folder can be written to")));
  document.act(EventCommand{"trawl", document.shown()->context().times[1], "lost"});
  document.settle();
  EXPECT_TRUE(document.state().events.empty()) << "what cannot be kept is not shown";
  EXPECT_FALSE(document.choices().failure.empty());
  EXPECT_TRUE(fs::is_empty(locked));
}

}  // namespace
}  // namespace sonar
