// SPDX-License-Identifier: Apache-2.0
// What docs/tutorial.md tells a beginner to do is there, in the menu and on the key that it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "base/test_paths.h"
#include "session/test_app.h"

namespace sonar {
namespace {

/// On one line, as a reader takes it.
std::string page_text() {
  std::ifstream file(test::source_tree() / "docs" / "tutorial.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

/// "File > Export > Results..."
std::string menu_path(const Action& action) {
  std::string menu = action.menu;
  std::erase(menu, '&');
  return std::regex_replace(menu, std::regex("/"), " > ") + " > " + action.text;
}

TEST(Tutorial, NamesActionsByTheirMenusAndKeys) {
  ChangeQueue queue;
  const AppModel app(queue, TestSurvey::options(TestSurvey::easy().fresh()));
  const std::string text = page_text();
  // *Menu > Text* (Key)
  const std::regex named(R"(\*([A-Z][^*]* > [^*]*)\*( \(([^)]*)\))?)");
  int count = 0;
  for (auto found = std::sregex_iterator(text.begin(), text.end(), named); found != std::sregex_iterator(); ++found) {
    const std::string path = (*found)[1];
    const auto& all = app.actions.list();
    const auto action = std::find_if(all.begin(), all.end(), [&](const Action& one) { return menu_path(one) == path; });
    ASSERT_NE(action, all.end()) << path;
    EXPECT_EQ((*found)[3].str(), action->keys.empty() ? "" : action->keys.front()) << path;
    ++count;
  }
  EXPECT_GE(count, 10) << "a step that names no action";
}

TEST(Tutorial, HasTenSteps) {
  const std::string text = page_text();
  EXPECT_NE(text.find(" 10. **"), std::string::npos);
  EXPECT_EQ(text.find(" 11. **"), std::string::npos);
}

}  // namespace
}  // namespace sonar
