// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/session_recipe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <span>
#include <system_error>

#include "base/test_paths.h"
#include "io/atomic_file.h"
#include "pipeline/journal/journals.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class SessionRecipe : public testing::Test {
 protected:
  ~SessionRecipe() override {
    std::error_code ignored;
    fs::remove_all(root, ignored);
  }
  const fs::path root = test::scratch_path("session-recipe");
};

TEST_F(SessionRecipe, IsReadBackFromTheLastFolderThatHasOne) {
  const std::array folders{root / "theirs", root / "ours", root / "none"};
  ASSERT_TRUE(kept_recipe(folders));
  EXPECT_FALSE(kept_recipe(folders)->has_value());
  Recipe recipe;
  recipe.detect.tolerance_db = 7.0;
  ASSERT_TRUE(keep_recipe(root / "theirs", Recipe{}));
  ASSERT_TRUE(keep_recipe(root / "ours", recipe));
  const auto kept = kept_recipe(folders);
  ASSERT_TRUE(kept && *kept);
  EXPECT_EQ(recipe_text(**kept), recipe_text(recipe));
}

TEST_F(SessionRecipe, ThatIsBrokenIsToldWithItsFile) {
  for (const char* text : {"{", R"({"recipe_version": 1, "median": {"kernel_fans": 4}})"}) {
    ASSERT_TRUE(write_file(root / "session-recipe.json", text));
    const auto kept = kept_recipe(std::span(&root, 1));
    ASSERT_FALSE(kept);
    EXPECT_EQ(kept.error().code, ErrorCode::format) << "what a file says is no wrong usage";
    EXPECT_THAT(to_line(kept.error()), testing::HasSubstr("session-recipe.json"));
  }
}

// A session's run follows the recipe that its window showed.
TEST_F(SessionRecipe, IsTheSessionsWhateverItsJournalBeganWith) {
  ASSERT_TRUE(fs::create_directories(root));
  Journal head;
  head.recipe = recipe_text(Recipe{});
  head.recipe_hash = recipe_hash(Recipe{});
  JournalLine line;
  line.n = 1;
  line.command = "detect";
  ASSERT_TRUE(append_journal((root / "session.jsonl").string(), head, line));
  Recipe recipe;
  recipe.detect.tolerance_db = 7.0;
  EXPECT_EQ(read_session(root)->recipe_hash, recipe_hash(Recipe{}));
  ASSERT_TRUE(keep_recipe(root, recipe));
  for (const fs::path& session : {root, root / "session.jsonl"}) {
    const auto read = read_session(session);
    ASSERT_TRUE(read) << to_line(read.error());
    const auto followed = recipe_from_text(read->recipe);
    ASSERT_TRUE(followed);
    EXPECT_EQ(followed->detect.tolerance_db, 7.0) << session;
    EXPECT_FALSE(followed->automatic) << "the session's lines say where schools are detected";
    EXPECT_EQ(read->recipe_hash, recipe_hash(*followed));
    EXPECT_EQ(read->lines.size(), 1U);
  }
}

}  // namespace
}  // namespace sonar
