// SPDX-License-Identifier: Apache-2.0
#include "session/words/all_words.h"

#include <gtest/gtest.h>

#include "session/numbers/fish_biomass.h"
#include "session/test_app.h"

namespace sonar {
namespace {

TEST(AllWords, HaveWhatMenusPanelsAndTablesSay) {
  ChangeQueue queue;
  AppModel app(queue, {});
  const std::set<std::string> words = all_words(app);
  for (const char* menu : {"&File", "&Export", "&View"}) EXPECT_TRUE(words.contains(menu)) << menu;
  const Action& action = *app.actions.find("schools.detect");
  EXPECT_TRUE(words.contains(action.text) && words.contains(action.tip));
  EXPECT_TRUE(words.contains(app.panel.front().title));
  EXPECT_TRUE(words.contains(app.rows("schools")->columns().front().title));
  for (const Property& one : app.workspace.display.properties()) {
    EXPECT_TRUE(words.contains(one.tooltip)) << one.name;
  }
  // Of windows that are opened later.
  for (const Property& one : app.fish->params.properties()) EXPECT_TRUE(words.contains(one.tooltip)) << one.name;
  EXPECT_TRUE(words.contains(app.integration->nasc_rows.columns().front().title));
  EXPECT_FALSE(words.contains(""));
}

}  // namespace
}  // namespace sonar
