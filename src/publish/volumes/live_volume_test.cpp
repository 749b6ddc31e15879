// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/live_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/task_thread.h"
#include "publish/renderer_choice.h"
#include "view/slices/slice_example.h"

namespace sonar {
namespace {

/// A block of strong echo, and a school's mask over it and a little more.
LiveVolumeInput block_of_echo() {
  const Sector sector = slice_example::hand_sector();
  const Shape3 shape{sector.fans(), sector.beams(), sector.range().count};
  auto staged = std::make_shared<StagedPing>();
  staged->filtered =
      std::make_shared<Volume>(Volume{Array3<std::int16_t>(shape, kMinCount), Array3<SampleFlags>(shape)});
  auto mask = std::make_shared<PingMask>();
  for (int fan = 3; fan < 6; ++fan) {
    for (int beam = 2; beam < 5; ++beam) {
      for (int s = 15; s < 25; ++s) staged->filtered->counts(fan, beam, s) = slice_example::LitVolume::counts(-30.0);
      mask->runs.push_back({fan * sector.beams() + beam, 13, 14});
      mask->confidence.insert(mask->confidence.end(), 14, 200);
    }
  }
  staged->sv = *staged->filtered;
  LiveVolumeInput input;
  input.staged = std::move(staged);
  input.sector = std::make_shared<const Sector>(sector);
  input.masks = {{std::move(mask), {1.0F, 0.0F, 1.0F}}};
  input.casting_shadow = {input.masks.front().mask};
  input.legend = {{{255, 0, 255, 255}, "school 1"}};
  input.options.size = {400, 300};
  input.options.volume.frames = 2;
  input.options.volume.context = false;
  input.options.volume.renderer = RendererChoice::cpu;
  return input;
}

/// The last and best picture's raster.
Image settled(LiveVolume& live, const LiveVolumeInput& input) {
  Work work(1);
  Image out;
  const auto done = live.draw(input, CancelToken{}, work, [&](const LiveVolume::Picture& picture) {
    for (const auto& item : picture.frame.items) {
      if (const auto* image = std::get_if<ImageItem>(&item)) {
        out = *image->image;
        break;
      }
    }
  });
  EXPECT_TRUE(done);
  return out;
}

// In a maximum and a first hit each pixel's colour is one Sv: with the school it is the picture without it, and lines.
TEST(LiveVolume, OutlinesSchoolsWhereAColourIsOneSv) {
  LiveVolume live;
  const LiveVolumeInput input = block_of_echo();
  const Theme theme = theme_of(input.options);
  const std::array<Rgba8, 3> colours{Rgba8{255, 0, 255, 255}, theme.text, theme.background};
  for (const RayMode mode : {RayMode::maximum, RayMode::first_hit}) {
    LiveVolumeInput with = input;
    with.options.volume.mode = mode;
    LiveVolumeInput without = with;
    without.masks.clear();
    without.legend.clear();
    const Image bare = settled(live, without);
    const Image lined = settled(live, with);
    ASSERT_EQ(bare.size, lined.size);
    int lines = 0;
    for (std::size_t i = 0; i < bare.pixels.size(); ++i) {
      if (bare.pixels[i] == lined.pixels[i]) continue;
      ++lines;
      ASSERT_TRUE(std::ranges::count(colours, lined.pixels[i]) > 0) << i;
    }
    EXPECT_GT(lines, 100);
    EXPECT_LT(lines, static_cast<int>(bare.pixels.size()) / 10);
    EXPECT_EQ(settled(live, with), lined) << "the same again";
  }
  // Accumulated, schools are lines unless a tint is asked for.
  LiveVolumeInput tinted = input;
  const Image line = settled(live, tinted);
  tinted.options.display.tint = true;
  EXPECT_NE(settled(live, tinted), line);
}

/// The words of the best picture.
std::vector<std::string> words_of(LiveVolume& live, const LiveVolumeInput& input) {
  Work work(1);
  std::vector<std::string> out;
  EXPECT_TRUE(live.draw(input, CancelToken{}, work, [&](const LiveVolume::Picture& picture) {
    out.clear();
    for (const auto& item : picture.frame.items) {
      if (const auto* text = std::get_if<TextItem>(&item)) out.push_back(text->text);
    }
  }));
  return out;
}

// Nothing is measured on what is interpolated: between pings the shadow is that of the nearer one, whose schools are drawn.
TEST(LiveVolume, BetweenPingsTheShadowIsTheNearerOnes) {
  LiveVolumeInput first = block_of_echo();
  first.options.volume.data = false;  // so that nothing but the shadow differs
  first.options.volume.context = true;
  first.options.display.shadow = true;
  first.options.display.shadow_db = 1.0;
  auto quiet = std::make_shared<StagedPing>(*first.staged);
  quiet->calibration = std::make_shared<const Array3<std::int16_t>>(quiet->sv.counts.shape(), std::int16_t{0});
  quiet->background_db.assign(quiet->sv.counts.shape().rows(), std::nan(""));
  first.staged = quiet;
  LiveVolumeInput second = first;
  auto louder = std::make_shared<StagedPing>(*quiet);
  for (auto& count : louder->sv.counts.all()) {
    if (count != kMinCount) count = slice_example::LitVolume::counts(-24.0);
  }
  louder->filtered = std::make_shared<Volume>(louder->sv);
  second.staged = louder;
  LiveVolume live;
  const Image of_first = settled(live, first);
  const Image of_second = settled(live, second);
  ASSERT_NE(of_first, of_second) << "a louder school's shadow begins earlier";
  LiveVolumeInput between = first;
  between.next = second.staged;
  for (const double fraction : {0.25, 0.75, 0.4}) {
    between.towards_next = fraction;
    EXPECT_EQ(settled(live, between), fraction < 0.5 ? of_first : of_second) << fraction;
  }
  between.options.display.shadow = false;
  EXPECT_NE(settled(live, between), of_first);
}

// The block's echoes are of -30 dB: no ray meets a surface of more, which the picture says instead of being empty. Where
// a school is outlined it is not empty.
TEST(LiveVolume, AFirstHitThatNothingReachesSaysSo) {
  LiveVolume live;
  LiveVolumeInput input = block_of_echo();
  input.options.volume.mode = RayMode::first_hit;
  const auto said = [&](double level_db) {
    input.options.volume.first_hit_db = level_db;
    const std::vector<std::string> words = words_of(live, input);
    return std::ranges::count(words, "nothing reaches \u221220 dB here");
  };
  EXPECT_EQ(said(-20.0), 0);
  input.masks.clear();
  input.legend.clear();
  EXPECT_EQ(said(-20.0), 1);
  EXPECT_EQ(said(-40.0), 0);
}

// The coarse picture that is seen while something moves has a school's line where the picture at rest has it, to within
// two of its coarse pixels, however many schools there are.
TEST(LiveVolume, OutlinesSchoolsWhileSomethingMoves) {
  LiveVolume live;
  LiveVolumeInput input = block_of_echo();
  input.options.volume.mode = RayMode::maximum;
  input.moving_budget_s = 1e-9;
  const Rgba8 colour{255, 0, 255, 255};
  const auto lines = [&](const Image& image) {
    PixelRect r{1e9, 1e9, -1e9, -1e9};  // x, y: the least; width, height: the largest
    for (int y = 0; y < image.size.height; ++y) {
      for (int x = 0; x < image.size.width; ++x) {
        if (image.at(x, y) != colour) continue;
        r = {std::min(r.x, 1.0 * x), std::min(r.y, 1.0 * y), std::max(r.width, 1.0 * x), std::max(r.height, 1.0 * y)};
      }
    }
    return r;
  };
  const auto drawn = [&] {
    std::vector<std::pair<int, Image>> out;
    Work work(1);
    EXPECT_TRUE(live.draw(input, CancelToken{}, work, [&](const LiveVolume::Picture& picture) {
      for (const auto& item : picture.frame.items) {
        const auto* image = std::get_if<ImageItem>(&item);
        if (image == nullptr) continue;
        out.emplace_back(picture.shown->divisor, *image->image);
        break;
      }
    }));
    return out;
  };
  auto pictures = drawn();
  ASSERT_GT(pictures.size(), 1U);
  ASSERT_GT(pictures.front().first, 1);
  const PixelRect first = lines(pictures.front().second);
  const PixelRect last = lines(pictures.back().second);
  ASSERT_GT(last.width, last.x);
  EXPECT_NEAR(first.x, last.x, 8.0);
  EXPECT_NEAR(first.y, last.y, 8.0);
  EXPECT_NEAR(first.width, last.width, 8.0);
  EXPECT_NEAR(first.height, last.height, 8.0);
  while (input.masks.size() < 40) input.masks.push_back(input.masks.front());
  pictures = drawn();
  EXPECT_GT(lines(pictures.front().second).width, 0.0);
  EXPECT_GT(lines(pictures.back().second).width, 0.0);
}

// Cut open at a slice, the echoes on the eye's side are gone, and come back; the school stays whole.
TEST(LiveVolume, IsCutOpenAtASlice) {
  LiveVolume live;
  LiveVolumeInput input = block_of_echo();
  input.fan = 4;
  input.beam = 3;
  std::shared_ptr<const LiveVolumeShown> shown;
  const auto draw = [&](VolumeClip clip, double orbit_deg) {
    input.options.volume.clip = clip;
    input.options.kind.volume.orbit_deg = orbit_deg;
    Work work(1);
    EXPECT_TRUE(live.draw(input, CancelToken{}, work, [&](const LiveVolume::Picture& p) { shown = p.shown; }));
    int echo = 0;
    for (const std::int16_t count : shown->volume->sv.all()) echo += count > kMinCount ? 1 : 0;
    return echo;
  };
  constexpr int kBlock = 3 * 3 * 10;
  EXPECT_EQ(draw(VolumeClip::none, 0.0), kBlock);
  const auto whole = shown->volume;
  EXPECT_EQ(draw(VolumeClip::none, 90.0), kBlock);
  EXPECT_EQ(shown->volume, whole) << "nothing is prepared again";
  // The overview is from above: the fans 3 and 4 of 3 to 5 are left.
  EXPECT_EQ(draw(VolumeClip::top_slice, 0.0), kBlock * 2 / 3);
  EXPECT_EQ(shown->volume->sv(5, 3, 20), kNoData);
  EXPECT_EQ(shown->masks.front().mask->voxels(), input.masks.front().mask->voxels());
  // Beams 2 to 4: whichever side the eye is on, the slice and one beam are left.
  EXPECT_EQ(draw(VolumeClip::side_slice, 0.0), kBlock * 2 / 3);
  const bool first = shown->volume->sv(4, 2, 20) != kNoData;
  EXPECT_EQ(draw(VolumeClip::side_slice, 180.0), kBlock * 2 / 3);
  EXPECT_EQ(shown->volume->sv(4, 2, 20) != kNoData, !first) << "seen from behind, the other side is cut away";
  EXPECT_EQ(draw(VolumeClip::both_slices, 0.0), kBlock * 4 / 9);
  EXPECT_EQ(draw(VolumeClip::none, 0.0), kBlock);
}

// A chart that cannot be read takes nothing else away, and is told of.
TEST(LiveVolume, AChartThatIsNotThereIsToldOf) {
  LiveVolume live;
  LiveVolumeInput input = block_of_echo();
  input.options.volume.context = true;
  const Image without = settled(live, input);
  input.options.depth_raster = "no-such-chart.tif";
  Work work(1);
  std::string notice;
  EXPECT_TRUE(live.draw(input, CancelToken{}, work, [&](const LiveVolume::Picture& p) { notice = p.shown->notice; }));
  EXPECT_NE(notice.find("no depth chart"), std::string::npos) << notice;
  EXPECT_EQ(settled(live, input), without);
}

}  // namespace
}  // namespace sonar
