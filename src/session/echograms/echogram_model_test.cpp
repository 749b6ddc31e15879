// SPDX-License-Identifier: Apache-2.0
#include "session/echograms/echogram_model.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "pipeline/stages/voxel_statistics.h"
#include "publish/picture.h"
#include "session/echograms/echogram_build.h"
#include "session/echograms/test_with_ek60.h"
#include "session/test_survey.h"

namespace sonar {
namespace {

using testing::HasSubstr;

/// The window's echogram over a survey.
class Echogram : public testing::Test {
 protected:
  explicit Echogram(const std::filesystem::path& survey = TestSurvey::easy().folder())
      : workspace_(queue_, TestSurvey::options(TestSurvey::easy().fresh())) {
    document().open({survey});
    echogram_.resize({900, 500}, 1.0);
    echogram_.set_seen(true);
    settle();
  }
  void settle() {
    do {
      document().settle();
      echogram_.wait();
    } while (queue_.drain() > 0);
  }
  Document& document() { return workspace_.document; }
  [[nodiscard]] const OpenObservation& shown() { return *document().shown(); }
  [[nodiscard]] TimeNs time_of(std::int64_t ping) {
    return shown().files().navigation[static_cast<std::size_t>(ping)].time;
  }
  /// Where a ping shows a sample of the beam that the echogram is of.
  [[nodiscard]] PixelPoint place_of(std::int64_t ping, double sample) {
    const EchogramPlot& plot = echogram_.places()->above;
    const double x = plot.places.x_of(time_of(ping)) + 2.0;
    const EchogramRow row = echogram_rows(shown().sector(), shown().placement(ping), plot.of.name.of).front();
    return {x, plot.places.plot.at(0.0, row.height_m(sample)).y};
  }
  void point(PixelPoint at, PointerAction action = PointerAction::move, PointerButton button = PointerButton::none) {
    echogram_.pointer({.action = action, .button = button, .at = at});
  }
  void click(PixelPoint at) {
    point(at);
    point(at, PointerAction::press, PointerButton::left);
    point(at, PointerAction::release, PointerButton::left);
    settle();
  }
  void wheel(PixelPoint at, double steps, bool control = false) {
    echogram_.pointer({.action = PointerAction::wheel, .at = at, .control = control, .wheel_steps = steps});
    settle();
  }

  ChangeQueue queue_;
  Workspace workspace_;
  std::shared_ptr<Echograms> echograms_ = std::make_shared<Echograms>(queue_, workspace_.document);
  EchogramModel echogram_{workspace_, echograms_};
};

TEST_F(Echogram, ACellIsTheSampleOfItsPingAndBeam) {
  ASSERT_TRUE(!!workspace_.display.set("removed", Choice{0}));  // as recorded
  workspace_.slices.set({7, 12});
  settle();
  const auto name = echogram_.name();
  ASSERT_TRUE(name);
  EXPECT_EQ(name->of, (EchogramOf{7, 12, EchogramHeight::range}));
  const EchogramPtr echogram = echograms_->of(*name);
  ASSERT_TRUE(echogram && echograms_->complete(*name));
  ASSERT_EQ(echogram->pings(), static_cast<std::size_t>(TestSurvey::kPings));
  Engine engine(shown().survey(), shown().files(), document().recipe());
  for (const std::int64_t ping : {0, 5, 11}) {
    const auto staged = engine.staged(ping);
    ASSERT_TRUE(staged);
    int seen = 0;
    for (int s = 0; s < shown().sector().range().count; ++s) {
      if (shown().sector().volume_m3(7, 12, s) == 0.0) continue;
      const int bin = bin_of(echogram->range(), shown().sector().range().range_m(s));
      ASSERT_GE(bin, 0);
      EXPECT_EQ(echogram->cell(0, static_cast<std::size_t>(ping), bin).mean_count(), staged->sv.counts(7, 12, s));
      ++seen;
    }
    EXPECT_GT(seen, 1000);
  }
}

// The shadow of a beam begins where slices have it, sample for sample; it is worked out once.
TEST_F(Echogram, ShadowBeginsWhereSlicesHaveIt) {
  document().detect({0});
  settle();
  const ProductPtr product = document().product(0);
  ASSERT_TRUE(product && !product->masks.empty());
  const int row = product->masks.front().mask.runs.front().row;
  const int beams = shown().sector().beams();
  ShadowWish wish{document().shown(), product, {row / beams, row % beams, EchogramHeight::range}, {}, 1e-4};
  wish.range = echogram_range(shown().sector(), {}, wish.of);
  EchogramShadows shadows;
  int pictures = 0;
  int pings = 0;
  const auto work_out = [&](const CancelToken& token) {
    shadows.work_out(
        wish, token, [&] { ++pings; }, [&] { ++pictures; });
  };
  CancelToken stopped;
  stopped.cancel();
  work_out(stopped);
  EXPECT_EQ(pings + pictures, 0);
  work_out({});
  EXPECT_GT(pictures, 0);
  const int read = pings;
  EXPECT_GT(read, 2);
  std::vector<EchogramStretch> expected;
  for (std::int64_t ping = 0; ping < shown().pings(); ++ping) {
    std::vector<const PingMask*> masks;
    for (const SchoolMask& mask : product->masks) {
      if (mask.ping_index == ping) masks.push_back(&mask.mask);
    }
    const auto staged = document().shown()->ping(ping);
    ASSERT_TRUE(staged);
    const int from = shadow_from(**staged, shown().sector(), masks, shown().recipe().measure.extinction,
                                 wish.least_db)[static_cast<std::size_t>(row)];
    if (from == shown().sector().range().count) continue;
    const double spacing_m = shown().sector().range().spacing_m;
    expected.push_back({static_cast<std::size_t>(ping), shown().sector().range().range_m(from) - 0.5 * spacing_m,
                        heights_of(wish.range).last_m});
  }
  const auto found = shadows.so_far(wish);
  ASSERT_GT(expected.size(), 2U);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].ping, expected[i].ping);
    EXPECT_NEAR(found[i].from_m, expected[i].from_m, 1e-6);
    EXPECT_NEAR(found[i].to_m, expected[i].to_m, 1e-6);
  }
  work_out({});
  EXPECT_EQ(pings, read) << "what is known is kept";
  wish.least_db = 0.2;
  EXPECT_TRUE(shadows.so_far(wish).empty()) << "another question";
}

// The slices' switch: on, with a ratio at which the small schools are dense, it changes the picture; off, it takes that back.
TEST_F(Echogram, TheSlicesSwitchHatchesShadow) {
  Recipe recipe = document().recipe();
  recipe.measure.extinction.ratio = 60.0;
  document().use_recipe(recipe);
  settle();
  document().detect({0});
  settle();
  const ProductPtr product = document().product(0);
  ASSERT_TRUE(product && !product->masks.empty());
  const int row = product->masks.front().mask.runs.front().row;
  workspace_.slices.set({row / shown().sector().beams(), row % shown().sector().beams()});
  settle();
  const Image plain = echogram_.image();
  ASSERT_TRUE(workspace_.display.set("shadow", true));
  settle();
  EXPECT_NE(echogram_.image().pixels, plain.pixels);
  ASSERT_TRUE(workspace_.display.set("shadow", false));
  settle();
  EXPECT_EQ(echogram_.image().pixels, plain.pixels);
}

TEST_F(Echogram, FollowsTheSlicesUnlessItIsHeld) {
  workspace_.slices.set({3, 4});
  settle();
  EXPECT_EQ(echogram_.places()->above.of.name.of, (EchogramOf{3, 4, EchogramHeight::range}));
  echogram_.set_held(true);
  workspace_.slices.set({9, 9});
  settle();
  EXPECT_EQ(echogram_.places()->above.of.name.of, (EchogramOf{3, 4, EchogramHeight::range}));
  echogram_.set_held(false);
  settle();
  EXPECT_EQ(echogram_.places()->above.of.name.of, (EchogramOf{9, 9, EchogramHeight::range}));
  echogram_.set_of_fan(true);
  echogram_.set_along_depth(true);
  settle();
  EXPECT_EQ(echogram_.places()->above.of.name.of, (EchogramOf{9, std::nullopt, EchogramHeight::depth}));
  EXPECT_EQ(echogram_.places()->above.places.plot.y.label, "depth (m)");
}

TEST_F(Echogram, AClickGoesToItsPingAndTheLineIsNoNewPicture) {
  const auto pictures = echogram_.pictures();
  click(place_of(7, 300));
  EXPECT_EQ(document().ping(), 7);
  EXPECT_EQ(echogram_.pictures(), pictures);
  ASSERT_FALSE(echogram_.overlays().empty());
  EXPECT_NEAR(echogram_.overlays()[0].line.front().x, echogram_.places()->above.places.x_of(time_of(7)), 1e-6);
  // A ping fills up to the next one: just before ping 8 still is ping 7.
  point(place_of(3, 300), PointerAction::press, PointerButton::left);
  point({echogram_.places()->above.places.x_of(time_of(8)) - 1.0, place_of(7, 300).y}, PointerAction::move,
        PointerButton::left);
  EXPECT_EQ(document().ping(), 7);
}

TEST_F(Echogram, TheCursorIsThatOfTheOtherViews) {
  workspace_.slices.set({7, 12});
  document().look_at(5);
  settle();
  for (const bool depth : {false, true}) {
    echogram_.set_along_depth(depth);
    settle();
    point(place_of(5, 400));
    EXPECT_EQ(workspace_.cursor(), (Voxel{7, 12, 400})) << depth;
    EXPECT_EQ(echogram_.overlays().size(), 1U) << "what points has no cross of its own";
    point(place_of(6, 400));
    EXPECT_FALSE(workspace_.cursor()) << "another ping than the one on show";
    point({0.0, 0.0}, PointerAction::leave);
    workspace_.cursor.set(Voxel{2, 3, 250});
    ASSERT_EQ(echogram_.overlays().size(), 2U);
    const PixelPoint cross = echogram_.overlays()[1].cross.value();
    EXPECT_NEAR(cross.y, place_of(5, 250).y, 1e-6) << "at its range, in the beam that is shown";
    EXPECT_NEAR(cross.x, echogram_.places()->above.places.x_of(time_of(5)), 1e-6);
  }
}

TEST_F(Echogram, AHintTellsPingTimeRangeDepthAndSv) {
  workspace_.slices.set({7, 12});
  settle();
  const std::string hint = echogram_.hint(place_of(5, 400));
  const RangeAxis& axis = shown().sector().range();
  const double range_m = axis.range_m(400);
  const double depth_m =
      shown().placement(5).transducer_depth_m - range_m * std::sin(shown().sector().elevation_rad(7));
  for (const std::string& words :
       {std::string("obs-0001, ping 5"), std::string("UTC"), std::string("beam 12 of fan 7"),
        fmt::format("range {:.1f} m", range_m), fmt::format("depth {:.1f} m", depth_m), std::string("Sv ")}) {
    EXPECT_THAT(hint, HasSubstr(words));
  }
  EXPECT_EQ(echogram_.hint({1.0, 1.0}), "");
}

TEST_F(Echogram, WheelMiddleButtonAndDoublePressZoomPanAndShowAll) {
  // Exactly the ping's time, which zooming about it leaves where it is.
  const auto place = [this] {
    const PixelPoint on_ping = place_of(6, 500);
    return PixelPoint{echogram_.places()->above.places.x_of(time_of(6)), on_ping.y};
  };
  const PixelPoint at = place();
  wheel(at, 1.0);
  EXPECT_TRUE(echogram_.zoomed());
  EXPECT_NEAR(place().x, at.x, 0.05) << "the time under the pointer stays";
  wheel(at, 3.0, true);
  EXPECT_NEAR(place().y, at.y, 0.05) << "so does the range";
  const PlotAxis zoomed = echogram_.places()->above.places.plot.y;
  EXPECT_LT(zoomed.last - zoomed.first, 0.6 * (echogram_.places()->heights.last_m));
  point(at, PointerAction::press, PointerButton::middle);
  point({at.x, at.y + 12.0}, PointerAction::move, PointerButton::middle);
  point({at.x, at.y + 12.0}, PointerAction::release, PointerButton::middle);
  settle();
  EXPECT_NEAR(place().y, at.y + 12.0, 0.05);
  point(at, PointerAction::double_press, PointerButton::left);
  settle();
  EXPECT_FALSE(echogram_.zoomed());
  EXPECT_NEAR(place().x, at.x, 0.05);
  EXPECT_NEAR(place().y, at.y, 0.05);
}

TEST_F(Echogram, BeamsThatNobodyLooksAtAreLetGoInTime) {
  std::vector<EchogramName> names;
  for (int beam = 0; beam < 9; ++beam) {
    workspace_.slices.set({5, beam});
    settle();
    names.push_back(*echogram_.name());
    EXPECT_TRUE(echograms_->complete(names.back()));
  }
  const auto kept = [&](const EchogramName& name) { return echograms_->of(name) != nullptr; };
  EXPECT_TRUE(kept(names.back()) && kept(names[6]));
  EXPECT_FALSE(kept(names[0]));
  EXPECT_LE(std::count_if(names.begin(), names.end(), kept), 6);
}

class EchogramWithEk60 : public Echogram {
 protected:
  EchogramWithEk60() : Echogram(with_ek60(true)) {}
};

TEST_F(EchogramWithEk60, ItsChannelsLieBelowUnderTheSameTime) {
  const auto& places = echogram_.places();
  ASSERT_TRUE(places && places->below);
  EXPECT_EQ(places->below->of.name.channel, 0);
  EXPECT_TRUE(echograms_->complete(places->below->of.name));
  EXPECT_NEAR(places->above.places.x_of(time_of(4)), places->below->places.x_of(time_of(4)), 1e-6);
  const PixelRect& plot = places->below->places.plot.place;
  const PixelPoint there{places->below->places.x_of(time_of(4)) + 2.0, plot.y + 0.5 * plot.height};
  EXPECT_THAT(echogram_.hint(there), HasSubstr("channel 1 of 2: 38 kHz"));
  click(there);
  EXPECT_EQ(document().ping(), 4) << "the ping of that time";
  echogram_.next_channel();
  settle();
  EXPECT_THAT(echogram_.hint(there), HasSubstr("channel 2 of 2: 120 kHz"));
  echogram_.set_other_below(false);
  settle();
  EXPECT_FALSE(echogram_.places()->below);
}

TEST_F(EchogramWithEk60, APictureTooLowForBothSaysSo) {
  EchogramWish wish;
  wish.survey = document().survey_files();
  wish.open = document().shown();
  wish.of = {*echogram_.name(), nullptr};
  wish.below = echogram_.places()->below->of;
  const auto says = [&](PixelSize size) {
    const auto built = built_echogram(wish, size);
    EXPECT_TRUE(built);
    return built && std::ranges::any_of(built->frame.items, [](const auto& item) {
             const auto* text = std::get_if<TextItem>(&item);
             return text != nullptr && text->text.starts_with("too low for two sounders");
           });
  };
  EXPECT_TRUE(says({400, 160}));
  EXPECT_TRUE(says({900, 270}));
  EXPECT_FALSE(says({900, 500}));
  wish.below.reset();
  EXPECT_FALSE(says({400, 160}));
}

TEST_F(EchogramWithEk60, AFileShowsBothToo) {
  Work work;
  const auto source = PictureSource::open(document().paths(), std::nullopt, work);
  ASSERT_TRUE(source) << to_line(source.error());
  PictureOptions options;
  options.size = {900, 700};
  options.kind.echogram.below = "auto";
  options.kind.echogram.channel = "120";
  const auto frame = picture_frame(PictureKind::echogram, **source, "obs-0001", options, work);
  ASSERT_TRUE(frame) << to_line(frame.error());
  const auto says = [&](const std::string& words) {
    return std::any_of(frame->items.begin(), frame->items.end(), [&](const auto& item) {
      const auto* text = std::get_if<TextItem>(&item);
      return text != nullptr && text->text.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("beam 12 of fan 10")) << "the middle one, where no school is known";
  EXPECT_TRUE(says("channel 2 of 2: 120 kHz"));
}

class EchogramOfEk60 : public Echogram {
 protected:
  EchogramOfEk60() : Echogram(with_ek60(false)) {}
};

TEST_F(EchogramOfEk60, IsShownWhereNothingHasFans) {
  EXPECT_FALSE(document().shown());
  EXPECT_EQ(echogram_.problem(), "");
  ASSERT_TRUE(echogram_.places());
  EXPECT_GT(echogram_.image().size.width, 0);
  EXPECT_EQ(echogram_.places()->above.of.name.channel, 0);
  ASSERT_TRUE(echogram_.places()->above.of.echogram);
  EXPECT_EQ(echogram_.places()->above.of.echogram->pings(), 30U);
  const PixelRect& plot = echogram_.places()->above.places.plot.place;
  const PixelPoint middle{plot.x + 0.5 * plot.width, plot.y + 0.5 * plot.height};
  EXPECT_THAT(echogram_.hint(middle), HasSubstr("Sv "));
  click(middle);  // nothing to go to: no harm
}

}  // namespace
}  // namespace sonar
