// SPDX-License-Identifier: Apache-2.0
#include "session/volume/volume_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/units.h"
#include "pipeline/stages/weak_samples.h"
#include "publish/renderer_choice.h"
#include "publish/test_renderer.h"
#include "session/volume/test_volume.h"
#include "session/volume/volume_input.h"

namespace sonar {
namespace {

/// Root mean square of what two pictures of the same size differ by, of the whole range of a colour.
double difference(const Image& a, const Image& b) {
  double sum = 0.0;
  const auto add = [&sum](int x, int y) { sum += (x - y) * (x - y) / (255.0 * 255.0); };
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    add(a.pixels[i].r, b.pixels[i].r);
    add(a.pixels[i].g, b.pixels[i].g);
    add(a.pixels[i].b, b.pixels[i].b);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels.size())));
}

class VolumeAtWork : public testing::Test, public VolumeApp {
 protected:
  /// The ping's filtered Sv as the display's switches leave it, looked up one sample after another. Within rounding of the
  /// limit a sample may be on either side.
  Array3<std::int16_t> left_of(const StagedPing& staged, NoiseLook removed, NoiseLook weak) {
    Array3<std::int16_t> left = staged.filtered->counts;
    const double limit_db = workspace_.display.values().weak_below_db;
    const Array3<std::int16_t>& drawn = model_->shown()->volume->sv;
    const Shape3 shape = left.shape();
    for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
      for (int s = 0; s < shape.samples; ++s) {
        const auto i = static_cast<std::size_t>(s);
        std::int16_t& count = left.view().row(row)[i];
        const auto snr_db = signal_to_noise_db(staged, row, s);
        const bool gone = removed != NoiseLook::shown && any(staged.filtered->flags.view().row(row)[i] & kNotFiltered);
        const bool tie = weak != NoiseLook::shown && snr_db && std::abs(*snr_db - limit_db) < 0.02;
        const bool noise = weak != NoiseLook::shown && snr_db && *snr_db < limit_db;
        if (tie) count = drawn.view().row(row)[i] == kNoData ? kNoData : count;
        if (gone || (noise && !tie)) count = kNoData;
      }
    }
    return left;
  }
};

TEST_F(VolumeAtWork, ItSettlesOnWhatRenderDraws) {
  // The bar of colours shows the curve, as it does where a transfer function is given.
  workspace_.curve_follows_scale.set(false);
  settle();
  ASSERT_TRUE(model_->shown()->done);
  // The same rays, averaged in the same order.
  EXPECT_EQ(model_->image(), rendered(model_->shown()->view.camera));
}

TEST_F(VolumeAtWork, TheFirstPictureIsCoarseAndLaterOnesComeNearer) {
  workspace_.curve_follows_scale.set(false);
  // A new model knows nothing of the machine's pace: the first picture fits its 5 ms only at a part of the resolution.
  model_ = std::make_unique<VolumeModel>(workspace_);
  std::vector<std::pair<int, Image>> pictures;
  const Listening heard_of(model_->changed(), [&] {
    if (model_->shown() != nullptr) pictures.emplace_back(model_->shown()->divisor, model_->image());
  });
  model_->resize(kVolumeTestSize, 1.0);
  model_->set_seen(true);
  settle();
  ASSERT_GE(pictures.size(), 3U);
  EXPECT_GT(pictures.front().first, 1);
  EXPECT_EQ(pictures.back().first, 1);
  const Image truth = rendered(model_->shown()->view.camera);
  // Large shapes are there from the beginning: less than a tenth of the range off, on average.
  EXPECT_LT(difference(pictures.front().second, truth), 0.1);
  for (std::size_t i = 1; i < pictures.size() && pictures[i - 1].first > 1; ++i) {
    EXPECT_LT(difference(pictures[i].second, truth), difference(pictures[i - 1].second, truth)) << i;
  }
  EXPECT_EQ(pictures.back().second, truth);
}

TEST_F(VolumeAtWork, AnotherPingIsAnotherVolume) {
  const Image first = model_->image();
  look_at(3);
  EXPECT_EQ(model_->shown()->ping_index, 3);
  const StagedPing& staged = *workspace_.document.staged();
  EXPECT_EQ(model_->shown()->volume->sv, left_of(staged, NoiseLook::hatched, NoiseLook::transparent));
  EXPECT_NE(model_->image(), first);
}

// Each sample is 10 log10 of the weighted mean of both pings' linear values; the picture says so, and pointers find nothing
// that they could measure. At rest it is the ping as measured, to the last pixel.
TEST_F(VolumeAtWork, BetweenPingsSvIsInterpolatedAndMarkedAndPointersFindNothing) {
  DisplayParams display = workspace_.display.values();
  display.removed = display.weak = NoiseLook::shown;
  workspace_.display.assign(display);
  settle();
  const Image measured = model_->image();
  const PixelPoint at = seen_place();
  const StagedPingPtr from = workspace_.document.staged();
  const StagedPingPtr to = *workspace_.document.shown()->ping(1);
  workspace_.motion.set({from, to, 0.25});
  settle();
  EXPECT_NE(model_->image(), measured);
  EXPECT_EQ(model_->shown()->ping_index, -1);
  EXPECT_TRUE(model_->hint(at).empty());
  const auto& drawn = model_->shown()->volume->sv;
  const auto linear = [](std::int16_t count) { return std::pow(10.0, db_from_counts(count) / 10.0); };
  std::size_t compared = 0;
  for (std::size_t i = 0; i < drawn.all().size(); i += 11) {  // all rows and ranges
    const std::int16_t a = from->filtered->counts.all()[i];
    const std::int16_t b = to->filtered->counts.all()[i];
    const std::int16_t here = drawn.all()[i];
    if (a == kNoData || b == kNoData || here == kNoData) continue;
    ++compared;
    ASSERT_NEAR(db_from_counts(here), 10.0 * std::log10(0.75 * linear(a) + 0.25 * linear(b)), 0.51 * kDbPerCount);
  }
  EXPECT_GT(compared, drawn.all().size() / 22);
  const PictureLook look{kVolumeTestSize, 1.0, false, {}};
  const auto input = volume_input(workspace_, std::nullopt, look);
  const auto& pings = workspace_.document.shown()->files().navigation;
  EXPECT_NEAR(static_cast<double>(input->navigation.time - pings[0].time),
              0.25 * static_cast<double>(pings[1].time - pings[0].time), 1.0);
  EXPECT_EQ(input->title_line, input->title + "   ping 0 to 1");
  std::set<std::string> words;
  Work work(1);
  ASSERT_TRUE(LiveVolume().draw(*input, CancelToken{}, work, [&](const LiveVolume::Picture& picture) {
    for (const auto& item : picture.frame.items) {
      if (const auto* text = std::get_if<TextItem>(&item)) words.insert(text->text);
    }
  }));
  EXPECT_TRUE(std::ranges::any_of(words, [](const std::string& text) {
    return text.starts_with("interpolated between");
  })) << "shortened by whole words in so small a picture";
  workspace_.motion.set({});
  settle();
  EXPECT_EQ(model_->image(), measured);
  EXPECT_EQ(model_->shown()->ping_index, 0);
  // Of a ping that is no longer on show there is no motion.
  workspace_.document.look_at(3);
  workspace_.document.settle();
  workspace_.motion.set({from, to, 0.25});
  EXPECT_EQ(volume_input(workspace_, std::nullopt, look)->next, nullptr);
}

// Sample by sample, by the rules of the display's own figures; stripes are not drawn in three dimensions.
TEST_F(VolumeAtWork, RemovedAndWeakSamplesAreLeftOutAsInSlices) {
  const StagedPing& staged = *workspace_.document.staged();
  DisplayParams display = workspace_.display.values();
  std::set<std::string> seen;
  for (const NoiseLook removed : {NoiseLook::shown, NoiseLook::hatched, NoiseLook::transparent}) {
    for (const NoiseLook weak : {NoiseLook::shown, NoiseLook::hatched, NoiseLook::transparent}) {
      display.removed = removed;
      display.weak = weak;
      workspace_.display.assign(display);
      settle();
      EXPECT_EQ(model_->shown()->volume->sv, left_of(staged, removed, weak));
      const auto all = model_->shown()->volume->sv.all();
      seen.insert(std::to_string(std::count(all.begin(), all.end(), kNoData)));
    }
  }
  EXPECT_EQ(seen.size(), 4U) << "each switch leaves out samples of its own";
  const auto volume = model_->shown()->volume;
  display.core_at = 0.5;
  workspace_.display.assign(display);
  settle();
  EXPECT_EQ(model_->shown()->volume, volume) << "what it does not depend on makes no new volume";
}

TEST_F(VolumeAtWork, WhatIsTriedIsDrawnButPointersPassThroughIt) {
  const Image before = model_->image();
  const PixelPoint at = seen_place();
  const auto picked = model_->shown()->picked_at(at);
  auto mask = std::make_shared<PingMask>();
  mask->runs = {{picked->fan * workspace_.document.shown()->sector().beams() + picked->beam,
                 std::max(0, picked->sample - 40), 41}};
  mask->confidence.assign(41, 255);
  workspace_.preview.set({workspace_.document.ping(), mask, "", 0});
  settle();
  EXPECT_NE(model_->image(), before);
  EXPECT_TRUE(model_->shown()->masks.empty());
  // As a line: all that lies off it has the data's own colours. As a tint: where it lies they change.
  const Image line = model_->image();
  DisplayParams params = workspace_.display.values();
  params.tint = true;
  workspace_.display.assign(params);
  settle();
  const Image tint = model_->image();
  const auto unlike = [&](const Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < before.pixels.size(); ++i) count += image.pixels[i] == before.pixels[i] ? 0 : 1;
    return count;
  };
  EXPECT_NE(line, tint);
  EXPECT_GT(unlike(line), 0);
  params.tint = false;
  workspace_.display.assign(params);
  workspace_.preview.set({});
  settle();
  EXPECT_EQ(model_->image(), before);
}

// Moving a slice moves its outline; where none is shown nothing is drawn again.
TEST_F(VolumeAtWork, SlicesAreShownWhereTheyLie) {
  const auto place = [&](int fan) {
    SlicePlaces places = workspace_.slices();
    places.fan = fan;
    workspace_.slices.set(places);
    settle();
    return model_->image();
  };
  const Image low = place(1);
  EXPECT_NE(place(4), low);
  EXPECT_EQ(place(1), low);
  VolumeParams params = workspace_.volume.values();
  params.slice_planes = false;
  workspace_.volume.assign(params);
  settle();
  const auto pictures = model_->pictures();
  (void)place(4);
  EXPECT_EQ(model_->pictures(), pictures);
  params.clip = VolumeClip::top_slice;
  workspace_.volume.assign(params);
  settle();
  const int last = workspace_.document.shown()->sector().fans() - 1;
  const Image cut = place(0);
  EXPECT_NE(place(last), cut) << "on one side all is cut away, on the other nothing";
}

// The seabed is the chart's where one is chosen; without, that of the ping's echoes.
TEST_F(VolumeAtWork, ADepthChartIsTheSeabed) {
  const Image without = model_->image();
  workspace_.depth_raster.set(TestSurvey::easy().folder() / "truth" / "depth.tif");
  settle();
  EXPECT_EQ(model_->shown()->notice, "");
  ASSERT_TRUE(model_->shown()->view.opaque_m);
  EXPECT_NE(model_->image(), without);
  VolumeParams params = workspace_.volume.values();
  params.seabed = false;
  workspace_.volume.assign(params);
  settle();
  const Image bare = model_->image();
  workspace_.depth_raster.set({});
  settle();
  EXPECT_EQ(model_->image(), bare);
  params.seabed = true;
  workspace_.volume.assign(params);
  settle();
  EXPECT_EQ(model_->image(), without);
}

TEST_F(VolumeAtWork, HiddenItDrawsNothingAndKeepsNothing) {
  auto watch = std::make_shared<Watch>();
  show(std::make_unique<VolumeModel>(workspace_, [watch](RendererChoice) -> Result<OffscreenRenderer> {
    return OffscreenRenderer{nullptr, std::make_unique<WatchedRenderer>(watch)};
  }));
  const Image shown = model_->image();
  EXPECT_EQ(watch->living, 1);
  model_->set_seen(false);
  settle();
  EXPECT_EQ(watch->living, 0);
  EXPECT_EQ(model_->shown(), nullptr);
  const auto pictures = model_->pictures();
  const int drawn = watch->drawn;
  look_at(2);
  workspace_.dark.set(true);
  settle();
  EXPECT_EQ(model_->pictures(), pictures);
  EXPECT_EQ(watch->drawn, drawn);
  EXPECT_EQ(watch->made, 1);
  // Shown again it is what it was.
  workspace_.dark.set(false);
  workspace_.document.look_at(0);
  model_->set_seen(true);
  settle();
  EXPECT_EQ(model_->image(), shown);
  EXPECT_EQ(watch->made, 2);
  model_.reset();
  EXPECT_EQ(watch->living, 0);
  // A context of OpenGL belongs to the thread that made it.
  EXPECT_EQ(watch->threads.size(), 1U);
  EXPECT_FALSE(watch->threads.contains(this_thread()));
}

TEST_F(VolumeAtWork, WhereOpenGlIsNotToBeHadTheProcessorDrawsAndSaysSo) {
  const Image by_processor = model_->image();
  show(std::make_unique<VolumeModel>(workspace_, [](RendererChoice choice) -> Result<OffscreenRenderer> {
    if (choice == RendererChoice::gl) return fail(ErrorCode::unsupported, "no graphics card");
    return offscreen_renderer(RendererChoice::cpu);
  }));
  const std::size_t told = workspace_.document.notices().size();
  ASSERT_TRUE(workspace_.volume.set("renderer", Choice{2}));
  settle();
  EXPECT_EQ(model_->image(), by_processor);
  ASSERT_EQ(workspace_.document.notices().size(), told + 1);
  EXPECT_NE(workspace_.document.notices().back().find("no graphics card"), std::string::npos);
}

TEST_F(VolumeAtWork, ADriverThatIsTakenAwayIsReplacedByTheProcessor) {
  const Image by_processor = model_->image();
  auto watch = std::make_shared<Watch>();
  show(std::make_unique<VolumeModel>(workspace_, [watch](RendererChoice choice) -> Result<OffscreenRenderer> {
    if (choice == RendererChoice::cpu) return offscreen_renderer(RendererChoice::cpu);
    return OffscreenRenderer{std::make_shared<int>(0), std::make_unique<WatchedRenderer>(watch)};
  }));
  ASSERT_TRUE(workspace_.volume.set("renderer", Choice{2}));
  settle();
  ASSERT_EQ(watch->living, 1);
  watch->fails = true;
  look_at(1);
  EXPECT_EQ(watch->living, 0);
  EXPECT_NE(model_->shown()->notice.find("taken away"), std::string::npos);
  look_at(0);
  EXPECT_EQ(model_->image(), by_processor);
}

TEST_F(VolumeAtWork, ARendererThatWasDestroyedDrawsTheSameWhenMadeAgain) {
  for (const std::size_t renderer : {std::size_t{1}, std::size_t{2}}) {
    ASSERT_TRUE(workspace_.volume.set("renderer", Choice{renderer}));
    settle();
    ASSERT_NE(model_->shown(), nullptr);
    if (!model_->shown()->notice.empty()) GTEST_SKIP() << "no OpenGL here: " << model_->shown()->notice;
    const Image before = model_->image();
    const std::string name = model_->shown()->renderer;
    model_->set_seen(false);
    settle();
    model_->set_seen(true);
    settle();
    EXPECT_EQ(model_->shown()->renderer, name);
    EXPECT_EQ(model_->image(), before) << name;
  }
}

}  // namespace
}  // namespace sonar
