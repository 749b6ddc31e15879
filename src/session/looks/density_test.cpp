// SPDX-License-Identifier: Apache-2.0
// Pictures on a dense screen: made for its pixels, with text and lines as large
// as ever, and pointed at in its pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "session/maps/test_maps.h"
#include "session/slices/test_slices.h"

namespace sonar {
namespace {

constexpr PixelSize kUnits{480, 360};

/// Whether every block of 2 x 2 pixels has one colour, as in a picture that was
/// made for half as many and enlarged.
bool enlarged(const Image& image, const PixelRect& inside) {
  for (int y = 2 * static_cast<int>(inside.y / 2.0 + 1.0); y + 1 < inside.y + inside.height; y += 2) {
    for (int x = 2 * static_cast<int>(inside.x / 2.0 + 1.0); x + 1 < inside.x + inside.width; x += 2) {
      const Rgba8 c = image.at(x, y);
      if (!(image.at(x + 1, y) == c) || !(image.at(x, y + 1) == c) || !(image.at(x + 1, y + 1) == c)) return false;
    }
  }
  return true;
}

std::vector<double> text_sizes(const FrameDescription& frame) {
  std::vector<double> sizes;
  for (const auto& item : frame.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) sizes.push_back(text->size_px);
  }
  return sizes;
}

const Image* raster_of(const FrameDescription& frame) {
  const Image* largest = nullptr;
  for (const auto& item : frame.items) {
    const auto* image = std::get_if<ImageItem>(&item);
    if (image != nullptr && (largest == nullptr || image->image->size.count() > largest->size.count())) {
      largest = image->image.get();
    }
  }
  return largest;
}

TEST(Density, ASliceHasAVoxelForEveryPixelOfTheScreenAndTextTwiceAsLarge) {
  SlicesApp app;
  app.look_at_bright();
  const auto at_one = app.top().picture();
  app.top().resize(kUnits, 2.0);
  app.settle();
  const auto at_two = app.top().picture();
  EXPECT_EQ(app.top().image().size, (PixelSize{2 * kUnits.width, 2 * kUnits.height}));
  EXPECT_EQ(at_two->frame.size, app.top().image().size);
  EXPECT_EQ(raster_of(at_two->frame)->size, at_two->map->size()) << "a voxel a pixel";
  EXPECT_NEAR(at_two->map->size().width, 2.0 * at_one->map->size().width, 2.0);
  EXPECT_FALSE(enlarged(app.top().image(), at_two->plot.place));
  const double largest_one = text_sizes(at_one->frame).at(0);
  EXPECT_EQ(text_sizes(at_two->frame).at(0), 2.0 * largest_one);
  // The same voxel lies at the same place of the screen, in pixels of half the
  // size.
  const Voxel& voxel = SlicesApp::bright().voxel;
  const PixelPoint one = *at_one->place_of(voxel);
  const PixelPoint two = *at_two->place_of(voxel);
  EXPECT_NEAR(two.x, 2.0 * one.x, 3.0);
  EXPECT_NEAR(two.y, 2.0 * one.y, 3.0);
  app.top().pointer(app.at(app.top(), voxel, PointerAction::move));
  ASSERT_TRUE(app.workspace().cursor());
  EXPECT_EQ(app.workspace().cursor()->beam, voxel.beam);
  EXPECT_NEAR(app.workspace().cursor()->sample, voxel.sample, 4);
}

TEST(Density, TheBrushIsAsLargeOnTheScreenAsEver) {
  SlicesApp app;
  app.look_at_bright();
  app.workspace().tool.set(ToolName::brush);
  const auto painted = [&](double scale) {
    app.top().resize(kUnits, scale);
    app.settle();
    for (const PointerAction action : {PointerAction::press, PointerAction::release}) {
      app.top().pointer(app.at(app.top(), SlicesApp::bright().voxel, action, PointerButton::left));
    }
    app.settle();
    const auto voxels = static_cast<double>(app.document().state().schools.at(0)->masks.pings.at(0).mask.voxels());
    app.document().undo();
    app.settle();
    return voxels;
  };
  const double at_one = painted(1.0);
  EXPECT_NEAR(painted(2.0), at_one, 0.15 * at_one);
}

TEST(Density, MapsStripsAndTimelinesAreMadeForTheScreensPixels) {
  TestMaps maps;
  maps.propagate(maps.bright(), 3);
  for (LivePicture* picture : std::vector<LivePicture*>{&maps.map, &maps.survey, &maps.strip, &maps.timeline}) {
    picture->resize({640, 480}, 2.0);
    picture->set_seen(true);
    maps.settle();
    EXPECT_EQ(picture->problem(), "");
    ASSERT_EQ(picture->image().size, (PixelSize{1280, 960}));
    EXPECT_FALSE(enlarged(picture->image(), {0.0, 0.0, 1280.0, 960.0}));
    picture->set_seen(false);
  }
}

TEST(Density, AHandThatClicksMayMoveAsFarAsEver) {
  MapGesture gesture;
  const PixelRect place{0.0, 0.0, 800.0, 600.0};
  const auto clicked = [&](double moved_px, double scale) {
    gesture.take({.action = PointerAction::press, .button = PointerButton::left, .at = {100.0, 100.0}}, place, 1.0,
                 scale);
    gesture.take({.action = PointerAction::move, .button = PointerButton::left, .at = {100.0 + moved_px, 100.0}}, place,
                 1.0, scale);
    return gesture.take(
               {.action = PointerAction::release, .button = PointerButton::left, .at = {100.0 + moved_px, 100.0}},
               place, 1.0, scale) == MapGesture::Did::clicked;
  };
  EXPECT_TRUE(clicked(2.0, 1.0));
  EXPECT_FALSE(clicked(5.0, 1.0));
  EXPECT_TRUE(clicked(5.0, 2.0));
  EXPECT_FALSE(clicked(8.0, 2.0));
}

}  // namespace
}  // namespace sonar
