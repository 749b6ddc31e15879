// SPDX-License-Identifier: Apache-2.0
#include "session/words/key_said.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "session/test_app.h"

namespace sonar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class KeySaidApp : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    paint(3, 4, 2, 2, 100);
    document().settle();
    listening_.to(app_->key_said.changed(), [this] { said_.push_back(app_->key_said.text()); });
  }
  /// What a key says, one line after the other.
  std::vector<std::string> key(const std::string& id) {
    said_.clear();
    app_->actions.press(*app_->actions.find(id));
    document().settle();
    return said_;
  }

  std::vector<std::string> said_;
  Listening listening_;
};

TEST_F(KeySaidApp, AnActIsSaidWithItsSchool) {
  select(1);
  EXPECT_THAT(key("school.fill_holes"), ElementsAre("Fill holes", "Fill holes of school 1"));
}

TEST_F(KeySaidApp, WhatTheWindowTellsOfItComesLast) {
  select(1);
  const auto said = key("review.accept");
  ASSERT_FALSE(said.empty());
  EXPECT_EQ(said.front(), "Accept");
  EXPECT_THAT(said.back(), HasSubstr("school 1 accepted; "));
}

TEST_F(KeySaidApp, ASwitchSaysWhetherItIsOn) {
  EXPECT_THAT(key("display.masks"), ElementsAre("Schools over the data", "Schools over the data: off"));
  EXPECT_EQ(key("display.masks").back(), "Schools over the data: on");
}

TEST_F(KeySaidApp, WhatCannotBeDoneIsSaidAndNotDone) {
  workspace().school.set(std::nullopt);
  const std::size_t lines = document().choices().lines->size();
  EXPECT_THAT(key("review.reject"), ElementsAre("Reject: select a school first"));
  EXPECT_EQ(document().choices().lines->size(), lines);
}

TEST_F(KeySaidApp, WhatAHandDoesAfterwardsIsNotTheKeys) {
  select(1);
  key("school.fill_holes");
  said_.clear();
  document().undo();
  document().settle();
  EXPECT_THAT(said_, ElementsAre());
}

}  // namespace
}  // namespace sonar
