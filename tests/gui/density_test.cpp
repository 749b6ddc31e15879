// SPDX-License-Identifier: Apache-2.0
// The window on a dense screen: in a process of its own, because a screen's
// density is asked for once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

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
  for (const PictureDock& one : desk_->pictures) {
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
  EXPECT_GE(seen_so_far, 4);
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

TEST_F(Density, PicturesAreMadeForTheScreensPixels) {
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::setenv("QT_SCALE_FACTOR", "2", 1);
    ::execl(self.c_str(), self.c_str(), "--gtest_filter=Density.DISABLED_OnAScreenTwiceAsDense",
            "--gtest_also_run_disabled_tests", "--gtest_brief=1", nullptr);
    ::_exit(127);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace sonar
