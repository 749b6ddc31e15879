// SPDX-License-Identifier: Apache-2.0
#include "session/noise/noise_steps_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "session/slices/slice_places.h"
#include "session/slices/test_slices.h"

namespace sonar {
namespace {

using Shows = SliceStepPlace::Shows;

class NoiseStepsPanel : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(workspace().views.set("noise_steps", true));
    panel().resize({900, 600}, 1.0);
    panel().set_seen(true);
    app_.look_at_bright();
    settle();
    ASSERT_TRUE(panel().sight()) << panel().problem();
  }
  Workspace& workspace() { return app_.workspace(); }
  NoiseStepsModel& panel() { return dynamic_cast<NoiseStepsModel&>(*app_.app.picture("noise_steps")); }
  void settle() {
    do {
      app_.settle();
      panel().wait();
    } while (app_.queue.drain() > 0);
  }
  const SliceStepPlace& place(Shows shows, std::size_t step) {
    const auto& places = panel().sight()->picture.places;
    const auto found = std::find_if(places.begin(), places.end(),
                                    [&](const SliceStepPlace& one) { return one.shows == shows && one.step == step; });
    EXPECT_NE(found, places.end());
    return *found;
  }
  static PixelPoint middle(const PixelRect& r) { return {r.x + 0.5 * r.width, r.y + 0.5 * r.height}; }
  void click(PixelPoint at, bool shift = false) {
    PointerEvent press{PointerAction::press, PointerButton::left, at};
    press.shift = shift;
    panel().pointer(press);
    settle();
  }
  std::size_t count(Shows shows) {
    const auto& places = panel().sight()->picture.places;
    return static_cast<std::size_t>(
        std::count_if(places.begin(), places.end(), [&](const SliceStepPlace& one) { return one.shows == shows; }));
  }
  const NoiseStepsParams& params() { return workspace().picture_file.values().kind.noise_steps; }

  SlicesApp app_;
};

TEST_F(NoiseStepsPanel, ShowsEveryStepOfThePingOnShow) {
  EXPECT_EQ(panel().problem(), "");
  EXPECT_EQ(count(Shows::step), kNoiseStepNames.size());
  EXPECT_EQ(&panel().sight()->steps->ping(), app_.document().staged().get()) << "the pipeline's own, not made anew";
  const std::int64_t pictures = panel().pictures();
  app_.document().look_at(app_.document().ping() + 1);
  settle();
  EXPECT_GT(panel().pictures(), pictures);
  EXPECT_EQ(&panel().sight()->steps->ping(), app_.document().staged().get());
}

TEST_F(NoiseStepsPanel, AClickComparesAStepWithTheOneBefore) {
  const auto median = static_cast<std::size_t>(NoiseStep::median);
  click(middle(place(Shows::step, median).plot));
  EXPECT_EQ(count(Shows::before), 1U);
  EXPECT_EQ(count(Shows::after), 1U);
  EXPECT_EQ(count(Shows::difference), 1U);
  EXPECT_EQ(count(Shows::step), kNoiseStepNames.size()) << "all stay in sight";
  (void)place(Shows::before, median - 1);
  (void)place(Shows::after, median);
  // With Shift: from unfiltered Sv on.
  click(middle(place(Shows::step, 0).plot), true);
  (void)place(Shows::before, 0);
  (void)place(Shows::after, median);
  app_.ask("noise.next");
  settle();
  (void)place(Shows::before, median);
  (void)place(Shows::after, median + 1);
  click(middle(place(Shows::after, median + 1).plot));
  EXPECT_FALSE(panel().comparing());
  EXPECT_EQ(count(Shows::after), 0U);
  click(middle(place(Shows::step, 0).plot));
  (void)place(Shows::before, 0);
  (void)place(Shows::after, kNoiseStepNames.size() - 1);  // all that was done
  app_.ask("noise.all");
  settle();
  EXPECT_EQ(params(), NoiseStepsParams{});
}

TEST_F(NoiseStepsPanel, ShowsTheSliceThatAHandWasOnLastAndWhatOfItIsShown) {
  EXPECT_TRUE(std::holds_alternative<TopSlice>(panel().sight()->picture.map->view().slice));
  PointerEvent wheel{PointerAction::wheel, PointerButton::none, {240, 180}};
  wheel.control = true;
  wheel.wheel_steps = 3.0;
  app_.side().pointer(wheel);
  settle();
  const SliceView& view = panel().sight()->picture.map->view();
  EXPECT_EQ(view.slice, live_slice(workspace(), SliceKind::side, app_.document().ping()));
  ASSERT_TRUE(app_.side().zoomed());
  EXPECT_EQ(view.extent, app_.side().picture()->map->view().extent) << "the same part";
  app_.side().show_all();
  settle();
  EXPECT_FALSE(panel().sight()->picture.map->view().extent);
  // Or the one that is named.
  ASSERT_TRUE(workspace().picture_file.set("noise-steps.slice", Choice{1}));
  settle();
  EXPECT_TRUE(std::holds_alternative<TopSlice>(panel().sight()->picture.map->view().slice));
  wheel.control = false;
  wheel.wheel_steps = 1.0;
  const int fan = workspace().slices().fan;
  wheel.at = middle(place(Shows::step, 3).plot);
  panel().pointer(wheel);
  settle();
  EXPECT_NE(workspace().slices().fan, fan) << "the wheel moves it";
}

TEST_F(NoiseStepsPanel, TellsASamplesFateUnderThePointerInEveryPicture) {
  const Voxel& bright = SlicesApp::bright().voxel;
  const SliceStepPlace& first = place(Shows::step, 0);
  const auto on_map = panel().sight()->picture.map->place_of(bright);
  ASSERT_TRUE(on_map);
  const PixelPoint at{on_map->x + first.plot.x, on_map->y + first.plot.y};
  PointerEvent move{PointerAction::move, PointerButton::none, at};
  panel().pointer(move);
  ASSERT_TRUE(workspace().cursor());
  EXPECT_EQ(workspace().cursor()->fan, bright.fan);
  EXPECT_EQ(panel().overlays().size(), kNoiseStepNames.size()) << "a cross in each";
  EXPECT_THAT(panel().hint(at), testing::HasSubstr("Unfiltered Sv: "));
  EXPECT_THAT(panel().hint(at), testing::HasSubstr("\nMedian filter: "));
  EXPECT_EQ(panel().hint({1.0, 1.0}), "");
}

// "Before/after" of a recipe: once it is used, the panel shows its steps.
TEST_F(NoiseStepsPanel, FollowsTheRecipe) {
  const auto words_of = [&](std::size_t step) {
    std::string all;
    for (const auto& item : panel().sight()->picture.frame.items) {
      if (const auto* text = std::get_if<TextItem>(&item); text && inside(place(Shows::step, step).place, text->at)) {
        all += text->text + "\n";
      }
    }
    return all;
  };
  const auto near = static_cast<std::size_t>(NoiseStep::near_field);
  EXPECT_GT(panel().sight()->steps->effect(NoiseStep::near_field).taken_out, 0);
  EXPECT_THAT(words_of(near), testing::HasSubstr("takes out"));
  Recipe recipe = app_.document().recipe();
  recipe.flags.near_field.enabled = false;
  app_.document().use_recipe(recipe);
  settle();
  EXPECT_THAT(words_of(near), testing::HasSubstr("off in the recipe"));
  EXPECT_EQ(panel().sight()->steps->effect(NoiseStep::near_field).taken_out, 0);
}

TEST_F(NoiseStepsPanel, ThatIsOffComputesNothing) {
  panel().set_seen(false);
  const std::int64_t pictures = panel().pictures();
  app_.document().look_at(app_.document().ping() + 1);
  settle();
  EXPECT_EQ(panel().pictures(), pictures);
}

}  // namespace
}  // namespace sonar
