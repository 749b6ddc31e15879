// SPDX-License-Identifier: Apache-2.0
// Bookmarks by keys and mouse: set in one ping, gone back to from the list, removed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QPixmap>
#include <QTreeView>

#include "session/marks/bookmarked_view.h"
#include "session/open/thumbnails.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class MarksInTheWindow : public WindowAtWork {
 protected:
  void SetUp() override {
    cache_ = TestSurvey::easy().fresh();
    open();
  }
  QTreeView& list() { return *view("marks")->findChild<QTreeView*>("rows"); }
  void click_row(int row) {
    const QRect at = list().visualRect(list().model()->index(row, 0));
    click_on(list().viewport(), {at.x() + 12.0, static_cast<double>(at.center().y())});
  }
};

TEST_F(MarksInTheWindow, ABookmarkIsSetByAKeyAndLeadsBackByAClick) {
  std::string asked;
  app_->dialogs.text = [&](const std::string& title, const std::string&, const std::string&) {
    asked = title;
    return std::string("two schools, one above the other");
  };
  look_at_school();
  const std::int64_t ping = document().ping();
  const BookmarkedView seen = view_now(workspace());
  key(Qt::Key_M, Qt::ControlModifier);
  EXPECT_EQ(asked, "Bookmark");
  key(Qt::Key_Right);
  key(Qt::Key_Right);
  key(Qt::Key_T);
  raise("marks");
  ASSERT_EQ(list().model()->rowCount(), 2);
  ASSERT_NE(document().ping(), ping);
  click_row(0);
  EXPECT_EQ(document().ping(), ping);
  EXPECT_EQ(view_now(workspace()), seen);
  const auto picture = list().model()->index(0, 0).data(Qt::DecorationRole).value<QPixmap>();
  EXPECT_EQ(picture.size(), QSize(kThumbnail.width, kThumbnail.height));
  EXPECT_TRUE(shows_something(picture)) << "as it was seen";
  EXPECT_FALSE(shows_something(list().model()->index(1, 0).data(Qt::DecorationRole).value<QPixmap>())) << "a trawl";
  keep_picture("marks");
  key(Qt::Key_Delete);
  EXPECT_EQ(list().model()->rowCount(), 1);
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(list().model()->rowCount(), 2);
}

}  // namespace
}  // namespace sonar
