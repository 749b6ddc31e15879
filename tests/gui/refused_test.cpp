// SPDX-License-Identifier: Apache-2.0
// Echoes that detection refused, by mouse and keys: list, mark, what hover says, the key that takes one in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QHelpEvent>
#include <QToolTip>
#include <QTreeView>
#include <algorithm>

#include "session/review/refused_layer.h"
#include "window_at_work.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class Refused : public WindowAtWork {
 protected:
  void SetUp() override {
    recipe_.detect.size.min_fans = 15;  // no school is so high: judge size refuses the survey's
    WindowAtWork::SetUp();
  }
  QTreeView& list() { return *view("refused")->findChild<QTreeView*>("rows"); }
  /// What the window says where a pointer rests.
  std::string tooltip(const std::string& dock, PixelPoint at) {
    move(dock, at);
    const QPoint place(static_cast<int>(at.x), static_cast<int>(at.y));
    QHelpEvent help(QEvent::ToolTip, place, view(dock)->mapToGlobal(place));
    QApplication::sendEvent(view(dock), &help);
    return QToolTip::text().toStdString();
  }
  const std::vector<PlacedMark>& marks() {
    return dynamic_cast<SliceModel&>(*app_->picture("top_slice")).picture()->refused;
  }
};

TEST_F(Refused, TheListGoesToIt_HoverSaysWhy_IMakesItASchool_AndUndoTakesThatBack) {
  key(Qt::Key_D);
  raise("refused");
  ASSERT_GE(list().model()->rowCount(), 1);
  const auto all = list().model()->rowCount();
  click_on(list().viewport(), {12.0, static_cast<double>(list().visualRect(list().model()->index(0, 0)).center().y())});
  ASSERT_TRUE(workspace().echo());
  const EchoName echo = *workspace().echo();
  const auto mark = std::ranges::find(marks(), echo.id, &PlacedMark::echo_id);
  ASSERT_NE(mark, marks().end()) << "the slices lie through it";
  const PixelPoint at = mark->at;
  EXPECT_THAT(tooltip("top_slice", at), HasSubstr(why_no_school(document(), echo)));
  keep_picture("refused-hover");
  EXPECT_THAT(why_no_school(document(), echo), HasSubstr("fans, 15 at least (judge size)"));

  key(Qt::Key_I);
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_LT(list().model()->rowCount(), all);
  EXPECT_TRUE(std::ranges::none_of(marks(), [&](const PlacedMark& left) { return left.echo_id == echo.id; }));
  ASSERT_TRUE(workspace().school()) << "it is selected";
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(document().state().schools.empty());
  EXPECT_EQ(list().model()->rowCount(), all);
  EXPECT_TRUE(std::ranges::any_of(marks(), [&](const PlacedMark& back) { return back.echo_id == echo.id; }));
  key(Qt::Key_M, Qt::ShiftModifier);
  EXPECT_TRUE(marks().empty());
}

}  // namespace
}  // namespace sonar
