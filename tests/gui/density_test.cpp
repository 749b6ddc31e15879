// SPDX-License-Identifier: Apache-2.0
// The window on a dense screen: in a process of its own, because a screen's
// density is asked for once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QScreen>
#include <cstdlib>

#include "window_at_work.h"

namespace sonar {
namespace {

class Density : public WindowAtWork {};

/// Runs with QT_SCALE_FACTOR=2.
TEST_F(Density, DISABLED_OnAScreenTwiceAsDense) {
  window_->resize(1400, 900);
  settle();
  ASSERT_EQ(window_->devicePixelRatioF(), 2.0);
  int seen_so_far = 0;
  for (const PictureDock& one : app_->pictures) {
    if (!one.picture->seen() || !one.picture->problem().empty()) continue;  // some are too small here
    ++seen_so_far;
    const QWidget* there = view(one.id);
    EXPECT_EQ(one.picture->image().size, (PixelSize{2 * there->width(), 2 * there->height()})) << one.id;
    // What is on the screen is the picture, pixel for pixel.
    const QImage seen = view(one.id)->grab().toImage().convertToFormat(QImage::Format_RGBA8888);
    const Image& made = one.picture->image();
    int same = 0;
    int looked_at = 0;
    for (int y = 5; y < made.size.height; y += 9) {
      for (int x = 5; x < made.size.width; x += 9, ++looked_at) {
        const Rgba8 c = made.at(x, y);
        same += seen.pixelColor(x, y) == QColor(c.r, c.g, c.b, c.a) ? 1 : 0;
      }
    }
    EXPECT_GT(same, looked_at * 98 / 100) << one.id << ": all but what lies over it";
  }
  EXPECT_GE(seen_so_far, 3) << "on a small screen the others are tabs";
  const Target target = look_at_school();
  const PixelPoint pixel = place_in("top_slice", target.voxel);
  const PixelPoint place{pixel.x / 2.0, pixel.y / 2.0};
  move("top_slice", place);
  ASSERT_TRUE(workspace().cursor());
  // A pointer's place is whole units, two pixels: what lies under it is no farther away, and half a cell.
  const PixelPoint pointed = place_in("top_slice", *workspace().cursor());
  EXPECT_NEAR(pointed.x, pixel.x, 6.0);
  EXPECT_NEAR(pointed.y, pixel.y, 6.0);
  keep_picture("dense");
  click("top_slice", place);
  EXPECT_EQ(document().state().schools.size(), 1U);
}

/// Runs with QT_SCALE_FACTOR=2, on a screen that is then small.
TEST_F(Density, DISABLED_OnAScreenOfFewUnits) {
  const QSize room = window_->screen()->availableSize();
  if (room.width() > 1000) GTEST_SKIP() << "the screen is large all the same";
  EXPECT_LE(window_->width(), room.width()) << "nothing of the window lies beyond the screen";
  EXPECT_LE(window_->height(), room.height());
  int drawn = 0;
  for (const PictureDock& one : app_->pictures) {
    if (!one.picture->seen()) continue;
    EXPECT_EQ(one.picture->problem(), "") << one.id;
    ++drawn;
  }
  EXPECT_GE(drawn, 3) << "two slices and a timeline; the others are tabs";
  look_at_school();
  keep_picture("few-units");
}

/// Runs a disabled test of this program on a screen twice as dense.
void run_dense(const char* test) {
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::setenv("QT_SCALE_FACTOR", "2", 1);
    ::execl(self.c_str(), self.c_str(), (std::string("--gtest_filter=Density.DISABLED_") + test).c_str(),
            "--gtest_also_run_disabled_tests", "--gtest_brief=1", nullptr);
    ::_exit(127);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(Density, PicturesAreMadeForTheScreensPixels) { run_dense("OnAScreenTwiceAsDense"); }

TEST_F(Density, TheWindowFitsAScreenOfFewUnits) { run_dense("OnAScreenOfFewUnits"); }

}  // namespace
}  // namespace sonar
