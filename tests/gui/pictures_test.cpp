// SPDX-License-Identifier: Apache-2.0
// The window beside pictures of it that a human has looked at (tests/data/gui).
// On failure the picture and what differs are in the folder that
// SONAR_GUI_PICTURES names. After a change that is meant:
//   SONAR_GUI_REMAKE=1 xvfb-run -a -s "-screen 0 1920x1200x24" sonar_gui_test
//   --gtest_filter='Pictures.*'
// writes them anew into tests/data/gui; look at each before it is kept.
#include <gtest/gtest.h>

#include <QStatusBar>
#include <QTreeView>
#include <filesystem>

#include "base/test_paths.h"
#include "publish/picture_output.h"
#include "render/compare_pictures.h"
#include "render/draw_frame.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

// Largest and mean difference of a channel, of 255, as for the golden pictures
// of `sonarx render`. Drawn: another Cairo or FreeType may smooth an edge a
// little differently, never move it by a pixel. Traced: vectors of another
// width sum in another order, so that a few rays that just meet a mask differ.
constexpr PictureThresholds kDrawn{64.0, 0.2};
constexpr PictureThresholds kTraced{96.0, 0.05};
// Widgets are compared as means of 8 x 8 pixels: another Qt may shape letters and frames a little differently. The whole
// window moved by a pixel changes no mean by more than 32, and all of them by 1.1 on the average; a label that is gone
// changes some mean by 51 or more, and a view of another size changes many.
constexpr PictureThresholds kWidgets{44.0, 1.5};
constexpr int kBlock = 8;

Image image_of(const QImage& grabbed) {
  const QImage plain = grabbed.convertToFormat(QImage::Format_RGBA8888);
  Image image({plain.width(), plain.height()});
  for (int y = 0; y < plain.height(); ++y) {
    for (int x = 0; x < plain.width(); ++x) {
      const QColor c = plain.pixelColor(x, y);
      image.at(x, y) = {static_cast<std::uint8_t>(c.red()), static_cast<std::uint8_t>(c.green()),
                        static_cast<std::uint8_t>(c.blue()), 255};
    }
  }
  return image;
}

Image means_of(const Image& image) {
  Image means({image.size.width / kBlock, image.size.height / kBlock});
  for (int y = 0; y < means.size.height; ++y) {
    for (int x = 0; x < means.size.width; ++x) {
      int r = 0;
      int g = 0;
      int b = 0;
      for (int i = 0; i < kBlock * kBlock; ++i) {
        const Rgba8 c = image.at(x * kBlock + i % kBlock, y * kBlock + i / kBlock);
        r += c.r;
        g += c.g;
        b += c.b;
      }
      const auto mean = [](int sum) { return static_cast<std::uint8_t>(sum / (kBlock * kBlock)); };
      means.at(x, y) = {mean(r), mean(g), mean(b), 255};
    }
  }
  return means;
}

class Pictures : public WindowAtWork {
 protected:
  void SetUp() override {
    WindowAtWork::SetUp();
    VolumeParams volume;
    volume.frames = 2;
    volume.renderer = RendererChoice::cpu;
    workspace().volume.assign(volume);
    window_->resize(1600, 1000);
    settle();
    app_->dialogs.reset_layout();
    settle();
    const Target target = look_at_school();
    double_click("top_slice", place_in("top_slice", target.voxel));
    ASSERT_EQ(document().state().schools.size(), 1U);
    window_->statusBar()->clearMessage();
    QTest::mouseMove(window_->windowHandle(), QPoint(window_->width() / 2, 3));  // away from every view
    settle();
  }

  /// means  compared as means of blocks
  void compare(const std::string& name, const Image& picture, const PictureThresholds& thresholds, bool means = false) {
    const fs::path kept = test::source_tree() / "tests/data/gui" / (name + ".png");
    if (qEnvironmentVariableIsSet("SONAR_GUI_REMAKE")) {
      fs::create_directories(kept.parent_path());
      ASSERT_TRUE(write_pixels(picture, kept));
      return;
    }
    const auto reference = read_png(kept);
    ASSERT_TRUE(reference) << "no picture is kept in " << kept;
    const PictureVerdict verdict = means && picture.size == reference->size
                                       ? compare_pictures(means_of(picture), means_of(*reference), thresholds)
                                       : compare_pictures(picture, *reference, thresholds);
    EXPECT_TRUE(verdict.equal) << name << ": " << verdict.text;
    const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
    if (verdict.equal || folder.isEmpty()) return;
    const fs::path out = folder.toStdString();
    EXPECT_TRUE(write_pixels(picture, out / (name + ".png")));
    EXPECT_TRUE(write_pixels(difference_picture(picture, *reference), out / (name + ".difference.png")));
  }
  void compare_view(const std::string& id, const PictureThresholds& thresholds) {
    raise(id);
    ASSERT_EQ(app_->picture(id)->problem(), "") << id;
    compare(id, app_->picture(id)->image(), thresholds);
  }
};

TEST_F(Pictures, ViewsLookAsTheyDid) {
  for (const char* id : {"top_slice", "side_slice", "observation_map", "survey_map", "propagation",
                         "observation_timeline", "survey_timeline"}) {
    compare_view(id, kDrawn);
  }
  compare_view("volume", kTraced);
}

TEST_F(Pictures, TheWindowLooksAsItDid) {
  compare("controls", image_of(view("controls")->grab().toImage()), kWidgets, true);
  compare("window", image_of(window_->grab().toImage()), kWidgets, true);
  workspace().dark.set(true);
  settle();
  compare("window-dark", image_of(window_->grab().toImage()), kWidgets, true);
  workspace().dark.set(false);
}

}  // namespace
}  // namespace sonar
