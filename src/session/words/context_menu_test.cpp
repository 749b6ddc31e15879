// SPDX-License-Identifier: Apache-2.0
#include "session/words/context_menu.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "session/test_app.h"

namespace sonar {
namespace {

class ContextMenus : public testing::Test, protected TestApp {
 protected:
  void SetUp() override { begin(); }
};

TEST_F(ContextMenus, EveryDockHasOneAndEveryEntryIsAnActionOfTheWindow) {
  std::set<std::string> docks;
  for (const PictureDock& dock : app_->pictures) docks.insert(dock.id);
  for (const RowsDock& dock : app_->lists) docks.insert(dock.id);
  ASSERT_GE(docks.size(), 14U);
  for (const std::string& dock : docks) {
    EXPECT_FALSE(context_menu(dock).empty()) << dock;
    std::set<std::string_view> once;
    for (const ActionGroup& group : context_menu(dock)) {
      for (const std::string_view id : group) {
        EXPECT_NE(app_->actions.find(id), nullptr) << dock << ": " << id;
        EXPECT_TRUE(once.insert(id).second) << dock << " has twice: " << id;
      }
    }
  }
  EXPECT_TRUE(context_menu("controls").empty());
}

TEST_F(ContextMenus, MenusOfTheBarAreInGroupsThatTheEyeCanTakeIn) {
  constexpr int kSeven = 7;  // Miller's number
  std::map<std::string, int> together;
  for (const Action& action : app_->actions.list()) {
    const bool digit = action.id.starts_with("review.species");
    int& run = together[action.menu];
    run = begins_group(action.id) ? 1 : run + (digit ? 0 : 1);
    // One a kind of picture, and one a survey.
    if (action.menu == "&File/Save &picture" || action.menu == "&File/Open &recent") continue;
    EXPECT_LE(run, kSeven) << action.id;
  }
  for (const std::string_view id : group_beginnings()) EXPECT_NE(app_->actions.find(id), nullptr) << id;
}

}  // namespace
}  // namespace sonar
