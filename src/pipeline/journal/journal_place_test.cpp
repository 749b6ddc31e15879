// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/journal_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>

#include "base/test_paths.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Place : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "work");
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] JournalPlace placed() const {
    const std::array folders{folder_ / "work"};
    auto place = place_journal(folders, {});
    EXPECT_TRUE(place);
    return place ? *place : JournalPlace{};
  }
  void act(const JournalPlace& place, std::int64_t n) const {
    JournalLine line;
    line.n = n;
    line.command = "propagate";
    ASSERT_TRUE(append_journal(place.path.string(), place.journal, line));
  }
  void put(const char* name, const std::string& text) const { std::ofstream(folder_ / "work" / name) << text; }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_ / "work"), fs::directory_iterator{}));
  }

  fs::path folder_ = test::scratch_path("-place");
};

TEST_F(Place, LookingLeavesNothingBehind) {
  EXPECT_EQ(placed().path, folder_ / "work" / "session.jsonl");
  EXPECT_EQ(entries(), 0U);
}

// A link that another user laid where a file of ours would be: what it points at is neither made nor changed.
TEST_F(Place, NothingIsWrittenThroughLinks) {
  std::ofstream(folder_ / "others") << "theirs";
  for (const char* name : {".session-probe", "session-2.jsonl"}) {
    fs::create_symlink(folder_ / "others", folder_ / "work" / name);
  }
  fs::create_symlink(folder_ / "not_there", folder_ / "work" / "session.jsonl");
  const JournalPlace place = placed();
  EXPECT_EQ(place.path, folder_ / "work" / "session-3.jsonl");
  EXPECT_THAT(place.notices, testing::Contains(HasSubstr("is a link")));
  act(place, 1);
  EXPECT_FALSE(fs::exists(folder_ / "not_there"));
  std::string others;
  std::ifstream(folder_ / "others") >> others;
  EXPECT_EQ(others, "theirs");
}

// Behind a journal that cannot be read, or that a newer program wrote, a new one is begun; each later start finds it again.
TEST_F(Place, LaterStartsFindWhatFollowedAJournalThatCannotBeRead) {
  for (const char* head : {"{\"journal_version\":2}\n{\"n\":1}\n", "no journal at all\n"}) {
    put("session.jsonl", head);
    for (std::int64_t n = 1; n <= 3; ++n) {
      const JournalPlace place = placed();
      EXPECT_EQ(place.path, folder_ / "work" / "session-2.jsonl");
      EXPECT_EQ(place.journal.lines.size(), static_cast<std::size_t>(n - 1));
      EXPECT_THAT(place.notices, testing::Contains(HasSubstr("session.jsonl")));
      act(place, n);
    }
    // Also when the first is gone, or can be read again: then what it says is said too.
    fs::remove(folder_ / "work" / "session.jsonl");
    EXPECT_EQ(placed().journal.lines.size(), 3U);
    JournalLine line;
    line.n = 1;
    line.command = "propagate";
    ASSERT_TRUE(append_journal((folder_ / "work" / "session.jsonl").string(), {}, line));
    EXPECT_EQ(placed().journal.lines.size(), 3U);
    EXPECT_EQ(placed().lines.size(), 4U);
    fs::remove(folder_ / "work" / "session.jsonl");
    fs::remove(folder_ / "work" / "session-2.jsonl");
  }
}

TEST_F(Place, AFolderThatIsALinkIsNotOurs) {
  fs::create_directory_symlink(folder_ / "work", folder_ / "link");
  const std::array folders{folder_ / "link", folder_ / "own"};
  const auto place = place_journal(folders, {});
  ASSERT_TRUE(place);
  EXPECT_EQ(place->path.parent_path(), folder_ / "own");
}

TEST_F(Place, ABrokenHeadIsGoneOnWith) {
  act(placed(), 1);
  const fs::path file = folder_ / "work" / "session.jsonl";
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  put("session.jsonl", "\1" + text.substr(1));
  for (std::int64_t n = 2; n <= 4; ++n) {
    const JournalPlace place = placed();
    EXPECT_EQ(place.path, file);
    EXPECT_EQ(place.journal.lines.size(), static_cast<std::size_t>(n - 1));
    EXPECT_THAT(place.notices, testing::Contains(HasSubstr("recipe")));
    act(place, n);
  }
}

}  // namespace
}  // namespace sonar
