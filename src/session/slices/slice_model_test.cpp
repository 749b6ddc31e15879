// SPDX-License-Identifier: Apache-2.0
#include "session/slices/slice_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "base/units.h"
#include "pipeline/stages/weak_samples.h"
#include "publish/picture_output.h"
#include "publish/reports/sample_looks.h"
#include "session/slices/school_layers.h"
#include "session/slices/test_slices.h"
#include "view/label_room.h"

namespace sonar {
namespace {

class SlicesAtWork : public testing::Test {
 protected:
  void SetUp() override { app_.look_at_bright(); }
  Workspace& workspace() { return app_.workspace(); }
  const Voxel& bright() { return SlicesApp::bright().voxel; }
  Rgba8 pixel(SliceModel& slice, const Voxel& voxel) {
    const PixelPoint at = *slice.picture()->place_of(voxel);
    return slice.image().at(static_cast<int>(at.x), static_cast<int>(at.y));
  }
  /// What a pixel of plain data must look like.
  Rgba8 sv_colour(SliceModel& slice, const Voxel& voxel) {
    // The voxel that the pixel shows, which need not be the one whose centre lies in it.
    const PixelPoint at = *slice.picture()->place_of(voxel);
    const Voxel shown = *slice.picture()->voxel_at({std::floor(at.x) + 0.5, std::floor(at.y) + 0.5});
    const auto& staged = *app_.document().staged();
    const Volume& volume = workspace().display.values().filtered ? *staged.filtered : staged.sv;
    return sv_colours(workspace().display.values().scale)[volume.counts(shown.fan, shown.beam, shown.sample)];
  }
  void plain_display() {
    DisplayParams params = workspace().display.values();
    params.removed = params.weak = NoiseLook::shown;
    workspace().display.assign(params);
    app_.settle();
  }

  SlicesApp app_;
};

// The 2007 paper shows its slices as recorded and filters what schools are grown on.
TEST_F(SlicesAtWork, SlicesAreAsRecordedUntilTheyAreAskedToBeFiltered) {
  plain_display();
  EXPECT_FALSE(workspace().display.values().filtered);
  app_.ask("display.filtered");
  app_.settle();
  EXPECT_TRUE(workspace().display.values().filtered);
}

TEST_F(SlicesAtWork, BothSlicesShowThePingOnTheirOwnFanAndBeam) {
  plain_display();
  for (SliceModel* slice : {&app_.top(), &app_.side()}) {
    EXPECT_EQ(slice->image().size, (PixelSize{480, 360}));
    EXPECT_TRUE(slice->problem().empty());
    EXPECT_EQ(pixel(*slice, bright()), sv_colour(*slice, bright()));
  }
  EXPECT_FALSE(app_.top().picture()->place_of({bright().fan + 1, bright().beam, bright().sample}));
  app_.ask("display.filtered");
  app_.settle();
  EXPECT_EQ(pixel(app_.top(), bright()), sv_colour(app_.top(), bright()));
  app_.ask("display.weak");
  app_.settle();
  EXPECT_EQ(workspace().display.values().scale.low_db, -70.0);
  EXPECT_EQ(pixel(app_.top(), bright()), sv_colour(app_.top(), bright()));
}

// Near the transducer every beam rings.
TEST_F(SlicesAtWork, AReasonThatIsSwitchedOffShowsItsSamplesAsRecorded) {
  const Voxel ringing{bright().fan, bright().beam, 36};
  const StagedPing& ping = *app_.document().staged();
  ASSERT_EQ(ping.filtered->flags(ringing.fan, ringing.beam, ringing.sample), SampleFlags::near_field);
  const auto recorded = ping.sv.counts(ringing.fan, ringing.beam, ringing.sample);
  ASSERT_NE(recorded, ping.filtered->counts(ringing.fan, ringing.beam, ringing.sample));
  DisplayParams params = workspace().display.values();
  params.filtered = true;
  params.removed = NoiseLook::transparent;
  params.scale.low_db = -150.0;
  params.scale.span_db = 200.0;
  workspace().display.assign(params);
  app_.settle();
  const Rgba8 nothing = pixel(app_.top(), ringing);
  EXPECT_NE(read_out(workspace(), ringing).sv, fmt::format("Sv {:.1f} dB", db_from_counts(recorded)));
  ASSERT_TRUE(workspace().display.set("take_out.interference", false));
  app_.settle();
  EXPECT_EQ(pixel(app_.top(), ringing), nothing) << "another reason's switch";
  ASSERT_TRUE(workspace().display.set("take_out.near_field", false));
  app_.settle();
  EXPECT_NE(pixel(app_.top(), ringing), nothing);
  EXPECT_EQ(read_out(workspace(), ringing).sv, fmt::format("Sv {:.1f} dB", db_from_counts(recorded)));
  EXPECT_THAT(read_out(workspace(), ringing).flags, testing::HasSubstr("near field"))
      << "the reason stays in the read-out";
}

TEST_F(SlicesAtWork, TheReadOutTellsTheShipsSpeedInKnotsAndItsLogInNauticalMiles) {
  const PingNavigation& ship =
      app_.document().shown()->files().navigation[static_cast<std::size_t>(app_.document().ping())];
  const ReadOut text = read_out(workspace(), bright());
  EXPECT_EQ(text.ship, fmt::format("ship {:.1f} kn", ship.speed_mps * 3600.0 / 1852.0));
  EXPECT_EQ(text.log, fmt::format("log {:.3f} nmi", ship.distance_nmi));
  EXPECT_THAT(text.line(), testing::HasSubstr(text.ship + ", " + text.log));
}

TEST_F(SlicesAtWork, AreReadInTheUnitsThatAreChosenAtOnce) {
  const auto labels = [&] {
    return std::pair(app_.top().picture()->plot.y.label, app_.side().picture()->plot.y.label);
  };
  EXPECT_EQ(labels(), std::pair(std::string("ahead (m)"), std::string("depth (m)")));
  ASSERT_TRUE(workspace().window.set("length_unit", Choice{static_cast<std::size_t>(LengthUnit::fathoms)}));
  app_.settle();
  EXPECT_EQ(labels(), std::pair(std::string("ahead (fm)"), std::string("depth (fm)")));
  EXPECT_THAT(read_out(workspace(), bright()).depth, testing::EndsWith(" fm"));
}

TEST_F(SlicesAtWork, TitlesSayThatTheDataIsSimulated) {
  for (SliceModel* slice : {&app_.top(), &app_.side()}) {
    const auto& items = slice->picture()->frame.items;
    EXPECT_TRUE(std::any_of(items.begin(), items.end(), [](const auto& item) {
      const auto* text = std::get_if<TextItem>(&item);
      return text != nullptr && text->text.starts_with("obs-0001 SYNTHETIC");
    }));
  }
}

TEST_F(SlicesAtWork, TheWheelTurnsToTheNextFanAndBeam) {
  PointerEvent wheel = app_.at(app_.top(), bright(), PointerAction::wheel);
  wheel.wheel_steps = 0.5;  // a fine wheel
  app_.top().pointer(wheel);
  EXPECT_EQ(workspace().slices().fan, bright().fan);
  app_.top().pointer(wheel);
  EXPECT_EQ(workspace().slices().fan, bright().fan + 1);
  wheel = app_.at(app_.side(), bright(), PointerAction::wheel);
  wheel.wheel_steps = -100.0;
  app_.side().pointer(wheel);
  EXPECT_EQ(workspace().slices(), (SlicePlaces{bright().fan + 1, 0}));
  app_.settle();
  EXPECT_TRUE(app_.side().picture()->place_of({3, 0, 100}));
  app_.ask("slice.fan_down");
  app_.ask("slice.beam_up");
  EXPECT_EQ(workspace().slices(), (SlicePlaces{bright().fan, 1}));
}

TEST_F(SlicesAtWork, ZoomKeepsThePlaceUnderThePointerAndPanFollowsIt) {
  SliceModel& top = app_.top();
  PointerEvent wheel = app_.at(top, bright(), PointerAction::wheel);
  wheel.wheel_steps = 3.0;
  wheel.control = true;
  const double before_m = top.picture()->map->extent().x1 - top.picture()->map->extent().x0;
  top.pointer(wheel);
  app_.settle();
  const double after_m = top.picture()->map->extent().x1 - top.picture()->map->extent().x0;
  EXPECT_NEAR(after_m, before_m / std::pow(1.25, 3.0), 1e-6 * before_m);
  PixelPoint now = *top.picture()->place_of(bright());
  EXPECT_NEAR(now.x, wheel.at.x, 1e-6);
  EXPECT_NEAR(now.y, wheel.at.y, 1e-6);
  top.pointer({PointerAction::press, PointerButton::middle, {200.0, 150.0}});
  top.pointer({PointerAction::move, PointerButton::middle, {220.0, 140.0}});
  top.pointer({PointerAction::release, PointerButton::middle, {220.0, 140.0}});
  top.pointer({PointerAction::move, PointerButton::none, {300.0, 300.0}});
  app_.settle();
  now = *top.picture()->place_of(bright());
  EXPECT_NEAR(now.x, wheel.at.x + 20.0, 1e-6);
  EXPECT_NEAR(now.y, wheel.at.y - 10.0, 1e-6);
  app_.ask("display.all");
  app_.settle();
  EXPECT_FALSE(top.zoomed());
  EXPECT_NEAR(top.picture()->map->extent().x1 - top.picture()->map->extent().x0, before_m, 1e-9);
}

TEST_F(SlicesAtWork, TheCursorOfOneViewIsSeenInTheOtherWithTheLineOfTheOtherSlice) {
  app_.top().pointer(app_.at(app_.top(), bright(), PointerAction::move));
  ASSERT_TRUE(workspace().cursor());
  EXPECT_EQ(workspace().cursor()->beam, bright().beam);
  const auto over = app_.side().overlays();
  ASSERT_EQ(over.size(), 2U);
  ASSERT_EQ(over[0].line.size(), 2U);
  const PixelPoint middle{0.5 * (over[0].line[0].x + over[0].line[1].x), 0.5 * (over[0].line[0].y + over[0].line[1].y)};
  ASSERT_TRUE(app_.side().picture()->voxel_at(middle));
  EXPECT_EQ(app_.side().picture()->voxel_at(middle)->fan, bright().fan);
  ASSERT_TRUE(over[1].cross);
  const auto voxel = app_.side().picture()->voxel_at(*over[1].cross);
  ASSERT_TRUE(voxel);
  EXPECT_EQ(voxel->fan, bright().fan);
  EXPECT_NEAR(voxel->sample, bright().sample, 8);
  EXPECT_EQ(app_.top().overlays().size(), 1U) << "no cross under the pointer itself";
  app_.top().pointer({PointerAction::leave, PointerButton::none, {}});
  EXPECT_FALSE(workspace().cursor());
  EXPECT_EQ(app_.side().overlays().size(), 1U);
}

TEST_F(SlicesAtWork, AHoverIsDrawnAndAClickTakesItsPlace) {
  SliceModel& top = app_.top();
  const std::int64_t before = top.pictures();
  top.pointer(app_.at(top, bright(), PointerAction::move));
  app_.settle();
  EXPECT_GT(top.pictures(), before);
  ASSERT_TRUE(workspace().preview().mask);
  const auto theme = light_theme({480, 360});
  auto layers = school_layers(workspace(), app_.document().ping(), theme);
  ASSERT_EQ(layers.size(), 1U);
  EXPECT_EQ(layers[0].number, 0);
  app_.click(top, bright());
  app_.settle();
  ASSERT_EQ(app_.document().state().schools.size(), 1U);
  layers = school_layers(workspace(), app_.document().ping(), theme);
  ASSERT_EQ(layers.size(), 1U);
  EXPECT_EQ(layers[0].number, 1);
  EXPECT_TRUE(layers[0].selected);
  app_.ask("display.masks");
  app_.settle();
  EXPECT_TRUE(school_layers(workspace(), app_.document().ping(), theme).empty());
}

TEST_F(SlicesAtWork, TheHintNamesLevelReasonAndSchool) {
  SliceModel& top = app_.top();
  app_.click(top, bright());
  app_.settle();
  EXPECT_THAT(top.hint(*top.picture()->place_of(bright())),
              testing::AllOf(testing::HasSubstr("Sv -"), testing::HasSubstr("school 1")));
  const auto& flags = app_.document().staged()->filtered->flags;
  int reasons = 0;
  for (int sample = 0; sample < flags.shape().samples; ++sample) {
    const auto at = top.picture()->place_of({bright().fan, bright().beam, sample});
    const auto shown = at ? top.picture()->voxel_at(*at) : std::nullopt;
    if (!shown || !any(flags(shown->fan, shown->beam, shown->sample))) continue;
    const std::string why = flag_text(flags(shown->fan, shown->beam, shown->sample));
    EXPECT_THAT(top.hint(*at), testing::HasSubstr("removed: " + why));
    ++reasons;
  }
  EXPECT_GT(reasons, 0);
  EXPECT_EQ(top.hint({-10.0, -10.0}), "");
}

TEST_F(SlicesAtWork, NothingIsBuiltForASliceThatIsNotSeen) {
  app_.side().set_seen(false);
  const std::int64_t before = app_.side().pictures();
  app_.ask("ping.next");
  app_.settle();
  EXPECT_EQ(app_.side().pictures(), before);
  app_.side().set_seen(true);
  app_.settle();
  EXPECT_GT(app_.side().pictures(), before);
}

TEST_F(SlicesAtWork, WeakSamplesAreThoseThatHardlyRiseAboveTheBackground) {
  const StagedPing& ping = *app_.document().staged();
  Array3<SampleFlags> flags(ping.filtered->flags.shape());
  const int row = bright().fan * 25 + bright().beam;
  flag_weak_rows(ping, std::array{row}, 3.0, flags.view());
  int weak = 0;
  for (int s = 0; s < flags.shape().samples; ++s) {
    const auto i = static_cast<std::size_t>(s);
    const auto snr_db = signal_to_noise_db(ping, row, s);
    const SampleFlags flag = flags.view().row(row)[i];
    EXPECT_EQ(flag & static_cast<SampleFlags>(127),
              ping.filtered->flags.view().row(row)[i] & static_cast<SampleFlags>(127));
    if (!snr_db || std::abs(*snr_db - 3.0) < 0.02) continue;
    EXPECT_EQ(any(flag & SampleFlags::low_snr), *snr_db < 3.0) << s;
    weak += *snr_db < 3.0 ? 1 : 0;
  }
  EXPECT_GT(weak, 0);
  EXPECT_GT(*signal_to_noise_db(ping, row, bright().sample), 3.0);
}

TEST(FlagStyleOfTheDisplay, FollowsBothChoices) {
  DisplayParams display;
  display.removed = NoiseLook::shown;
  display.weak = NoiseLook::shown;
  EXPECT_EQ(flag_style(display), FlagStyle{});
  display.removed = NoiseLook::transparent;
  display.weak = NoiseLook::hatched;
  EXPECT_EQ(flag_style(display).hidden, kNotFiltered);
  EXPECT_EQ(flag_style(display).hatched, SampleFlags::low_snr);
}

TEST(FuzzyArea, KeepsWhatIsSurer) {
  const auto mask = std::make_shared<const PingMask>(PingMask{{{3, 10, 4}, {4, 7, 1}}, {100, 30, 200, 51, 20}});
  EXPECT_EQ(fuzzy_area(mask, 0.0), mask);
  EXPECT_EQ(*fuzzy_area(mask, 0.2), (PingMask{{{3, 10, 1}, {3, 12, 1}}, {100, 200}}));  // 51 / 255 is not above 0.2
}

// At any size: whole within the axes, off the school, off the ship and off all other words.
TEST_F(SlicesAtWork, TheSelectedSchoolsNameIsWholeAndLiesOnNothing) {
  app_.click(app_.top(), bright());
  app_.settle();
  const PingMask mask = in_ping(app_.document().state().schools.front()->masks, app_.document().ping())->mask;
  const int beams = app_.document().shown()->sector().beams();
  int named = 0;
  for (const PixelSize size : {PixelSize{340, 230}, {360, 270}, {480, 360}, {900, 700}}) {
    for (SliceModel* slice : {&app_.top(), &app_.side()}) {
      slice->resize(size, 1.0);
      app_.settle();
      const SlicePicture& picture = *slice->picture();
      std::vector<PixelRect> words;
      std::optional<PixelRect> name;
      for (const auto& item : picture.frame.items) {
        const auto* text = std::get_if<TextItem>(&item);
        if (text == nullptr || text->turned_deg != 0.0) continue;  // an axis' name stands beside the axes
        (text->text == "school 1" ? name.emplace() : words.emplace_back()) = LabelRoom::box_of(*text);
      }
      if (!name) continue;
      ++named;
      const PixelRect& plot = picture.plot.place;
      EXPECT_TRUE(inside(plot, {name->x, name->y})) << size.width;
      EXPECT_TRUE(inside(plot, {name->x + name->width, name->y + name->height})) << size.width;
      const PixelPoint ship = picture.map->pixel_of(0.0, 0.0);
      EXPECT_FALSE(inside(*name, {plot.x + ship.x, plot.y + ship.y})) << size.width;
      for (const PixelRect& other : words) {
        const bool apart = other.x >= name->x + name->width || name->x >= other.x + other.width ||
                           other.y >= name->y + name->height || name->y >= other.y + other.height;
        EXPECT_TRUE(apart) << size.width << " at " << other.x << ", " << other.y;
      }
      for (const sonar::Run& run : mask.runs) {
        for (int sample = run.first_sample; sample < run.end(); ++sample) {
          const Voxel voxel{run.row / beams, run.row % beams, sample};
          const bool shown = slice == &app_.top() ? voxel.fan == bright().fan : voxel.beam == bright().beam;
          const auto at = picture.place_of(voxel);
          ASSERT_FALSE(shown && at && inside(*name, *at)) << size.width;
        }
      }
    }
  }
  EXPECT_GE(named, 7) << "there is room for it almost always";
}

// What was rejected is no school, and takes no sound out of the beams.
TEST_F(SlicesAtWork, OutlineAndShadowTellWhatAHumanSaid) {
  app_.click(app_.top(), bright());
  app_.settle();
  const Theme theme = light_theme({480, 360});
  const auto layer = [&] {
    const auto layers = school_layers(workspace(), app_.document().ping(), theme);
    const auto found =
        std::find_if(layers.begin(), layers.end(), [](const SchoolLayer& one) { return one.number > 0; });
    return found == layers.end() ? SchoolLayer{} : *found;
  };
  EXPECT_EQ(layer().layer.line, OutlineLine::dashed);
  EXPECT_TRUE(layer().casts_shadow);
  app_.ask("review.accept");
  app_.settle();
  EXPECT_EQ(layer().layer.line, OutlineLine::solid);
  EXPECT_TRUE(layer().casts_shadow);
  app_.ask("review.reject");
  app_.settle();
  EXPECT_EQ(layer().layer.line, OutlineLine::dotted);
  EXPECT_FALSE(layer().casts_shadow);
  EXPECT_NEAR(255.0 * static_cast<double>(layer().layer.rgb[0]), theme.muted.r, 0.5);
}

TEST(DrawnColour, RejectedIsGreyAndNoSchoolLooksLikeThePreview) {
  const Theme theme = dark_theme({480, 360});
  StateSchool school;
  for (school.number = 1; school.number < 20; ++school.number) EXPECT_NE(drawn_colour(school, theme), preview_colour());
  school.masks.decided.status = "rejected";
  EXPECT_EQ(drawn_colour(school, theme), theme.muted);
}

}  // namespace
}  // namespace sonar
